#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "signweave/transition/body_scene.h"
#include "signweave/transition/finger_guard.h"
#include "signweave/transition/gap.h"
#include "signweave/transition/wrist_guard.h"

namespace signweave {

/// A made frame may lie so much deeper inside the body than the frames on both sides of its gap. Metres.
inline constexpr float kDepthAllowed = 0.003f;

/// Keeps arms that were made within what a body can do: hands out of head, trunk and each other, forearms out of the
/// trunk, fingers out of each other, wrists within human limits. Made once per signer, it belongs to one thread; the
/// second gap of some length allocates nothing.
class BodyGuard {
 public:
  /// Where the body's size is not known, or an arm, nothing is guarded.
  BodyGuard(const Skeleton& skeleton, const SignerModel& signer, const JointGroups& groups);

  /// Examines the frames of a gap that were made for `groups`, whole poses, each of the groups' arms by itself:
  ///
  /// - A wrist that is bent farther than people's are, and than at both borders, is turned back (see WristGuard).
  /// - Where a hand goes deeper into the head, a side of the trunk or the other hand, or a forearm into a side of the
  ///   trunk, than it is at either border, and kDepthAllowed, its trajectory is bent outwards: the wrist is shifted
  ///   where it is deepest, or the elbow swivelled where that leads a forearm farther, fading out smoothly to nothing
  ///   at both borders, so that position and velocity are kept there. The hand keeps its orientation, but for the
  ///   limits of its wrist. Repeated until no frame is too deep, at most kRounds times; of all rounds that one stays
  ///   whose deepest frame is least deep. A hand is led no farther than a hand's breadth out of the other one. Where
  ///   some frame still is too deep, the hand at least is led out of head and trunk, by as many rounds that look at
  ///   nothing else.
  /// - Fingers that cross are bent apart (see FingerGuard).
  ///
  /// Not every frame is examined. Between two that are, others are skipped where the arm moves less than the distance
  /// that it has left on both sides, or so little that it cannot pass through anything in between.
  ///
  /// Returns whether anything was bent. (ours)
  bool mend(const Gap& gap, GroupSet groups, MutablePoses made);

  static constexpr int kRounds = 24;

 private:
  /// The joints that are bent: shoulder, elbow, wrist.
  using Bent = std::array<Eigen::Quaternionf, 3>;
  /// How the arm is led out of what it is in: either shift or swivel is zero.
  struct Correction {
    Eigen::Vector3f shift = Eigen::Vector3f::Zero();  ///< of the wrist, metres, model space
    float swivel = 0;                                 ///< of the elbow, radians
    float peak = 0;                                   ///< the moment at which it is whole, from 0 to 1
  };
  /// A frame that is examined.
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
  Correction way_out(const Knot& deepest, float beyond, std::size_t meeting);
  void apply(const Correction& correction, std::int64_t frame);
  void restore(const Bent& bent, MutablePoseView pose) const;
  bool mend_arm(const Gap& gap, Side side, bool with_fingers, MutablePoses made);

  const Skeleton* skeleton_;
  BodyScene scene_;
  std::array<FingerGuard, 2> fingers_;  ///< [Side]
  std::array<WristGuard, 2> wrists_;    ///< [Side]
  // Of the gap and arm at hand:
  const Gap* gap_ = nullptr;
  Side side_ = Side::left;
  std::array<float, kMeetings> allowed_{};
  Eigen::Vector3f passing_;  ///< from border to border, of this hand as the other sees it; metres, model space
  Eigen::Vector3f apart_;    ///< unit, the direction in which the hands were led apart at first; zero: they were not
  float led_apart_ = 0;      ///< so far in that direction, metres
  float hand_reach_ = 0;     ///< from the wrist to what is farthest of the hand at a border, metres
  std::vector<Knot> knots_, added_;  ///< by frame, both borders among them
  std::vector<Correction> corrections_;
};

}  // namespace signweave
