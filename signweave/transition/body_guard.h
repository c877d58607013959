#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "signweave/transition/body_scene.h"
#include "signweave/transition/finger_guard.h"
#include "signweave/transition/gap.h"
#include "signweave/transition/wrist_guard.h"

namespace signweave {

/// How much deeper inside the body a generated frame may be than the frames on both sides of its gap. Metres.
inline constexpr float kDepthAllowed = 0.003f;

/// Keeps generated arms anatomically possible: hands out of head, trunk and each other, forearms out of the trunk,
/// fingers out of each other, wrists within human limits. Created once per signer; used by one thread. A second gap of
/// the same length allocates nothing.
class BodyGuard {
 public:
  /// Guards nothing if the body's size or an arm is unknown.
  BodyGuard(const Skeleton& skeleton, const SignerModel& signer, const JointGroups& groups);

  /// Corrects the frames of a gap that were generated for `groups`. `made` holds whole poses; each arm in `groups` is
  /// handled separately:
  ///
  /// - A wrist that is bent beyond human limits, and farther than at both borders, is turned back (see WristGuard).
  /// - If a hand is deeper in the head, a side of the trunk or the other hand, or a forearm deeper in a side of the
  ///   trunk, than at either border plus kDepthAllowed, its trajectory is bent outwards. The wrist is shifted at the
  ///   deepest frame, or the elbow is swivelled if that moves a forearm farther out. The correction fades smoothly to
  ///   zero at both borders, so position and velocity are preserved there. The hand keeps its orientation, within the
  ///   limits of its wrist. This repeats until no frame is too deep, at most kRounds times; the round whose deepest
  ///   frame is least deep is used. A hand is moved at most a hand's breadth out of the other one. If some frame is
  ///   still too deep, as many further rounds consider the hand against head and trunk only.
  /// - Crossing fingers are bent apart (see FingerGuard), also those of a hand whose arm is not in `groups`.
  ///
  /// Not every frame is examined. Frames between two examined ones are skipped if the arm moves less than its clearance
  /// at both of them, or too little to pass through anything in between.
  ///
  /// Returns true if anything was changed. (ours)
  bool repair(const Gap& gap, GroupSet groups, MutablePoses made);

  static constexpr int kRounds = 24;

 private:
  /// Rotations of the corrected joints: shoulder, elbow, wrist.
  using Bent = std::array<Eigen::Quaternionf, 3>;
  /// One correction that moves the arm outwards; either shift or swivel is zero.
  struct Correction {
    Eigen::Vector3f shift = Eigen::Vector3f::Zero();  ///< of the wrist, metres, model space
    float swivel = 0;                                 ///< of the elbow, radians
    float peak = 0;                                   ///< the moment of full effect, from 0 to 1
  };
  /// An examined frame.
  struct Knot {
    std::int64_t frame = 0;  ///< -1: the left border; `count`: the right one
    ArmPlace place;
    Eigen::Vector3f origin = Eigen::Vector3f::Zero();  ///< between the shoulders
    Eigen::Vector3f other = Eigen::Vector3f::Zero();   ///< the other arm's wrist
    Depths depths;
    Bent as_made;
  };

  Knot knot_at(std::int64_t frame);
  void look(Knot& knot);
  void begin(const Gap& gap, Side side);
  bool may_hide(const Knot& a, const Knot& b) const;
  bool refine();
  bool lead_out();
  Correction correction_for(const Knot& deepest, float beyond, std::size_t meeting);
  void apply(const Correction& correction, std::int64_t frame);
  void restore(const Bent& bent, MutablePoseView pose) const;
  bool repair_arm(const Gap& gap, Side side, bool with_fingers, MutablePoses made);

  const Skeleton* skeleton_;
  BodyScene scene_;
  std::array<FingerGuard, 2> fingers_;  ///< [Side]
  std::array<WristGuard, 2> wrists_;    ///< [Side]
  // State of the current gap and arm:
  const Gap* gap_ = nullptr;
  Side side_ = Side::left;
  std::array<float, kMeetings> allowed_{};
  Eigen::Vector3f passing_;  ///< motion of this hand relative to the other from border to border; metres, model space
  Eigen::Vector3f apart_;    ///< unit, the direction in which the hands were first moved apart; zero: they were not
  float led_apart_ = 0;      ///< total in that direction, metres
  float hand_reach_ = 0;     ///< from the wrist to the farthest point of the hand at a border, metres
  std::vector<Knot> knots_, added_;  ///< by frame, including both borders
  std::vector<Correction> corrections_;
};

}  // namespace signweave
