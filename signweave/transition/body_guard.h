#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "signweave/features/contact.h"
#include "signweave/features/hand_points.h"
#include "signweave/motion/kinematics.h"
#include "signweave/transition/arm_reach.h"
#include "signweave/transition/finger_guard.h"
#include "signweave/transition/gap.h"
#include "signweave/transition/wrist_limits.h"

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

  /// Looks at the frames of a gap that were made for `groups`, whole poses, each of the groups' arms by itself:
  ///
  /// - A wrist that is bent farther than people's are, and than at both borders, is turned back, each frame by itself
  ///   and so that what is smooth stays smooth (see WristLimits).
  /// - Where a hand goes deeper into the head, a side of the trunk or the other hand, or a forearm into a side of the
  ///   trunk, than it is at either border, and kDepthAllowed, its way is bent outwards: the wrist is shifted where it
  ///   is deepest, or the elbow swivelled where that leads a forearm farther, fading out smoothly to nothing at both
  ///   borders, so that position and velocity go on there. The hand keeps its orientation, but for the limits of its
  ///   wrist. Repeated until no frame is too deep, at most kRounds times; of all rounds that one stays whose deepest
  ///   frame is least deep. Where some frame still is too deep, the hand at least is led out of head and trunk, by as
  ///   many rounds that look at nothing else.
  /// - Fingers that cross are bent apart (see FingerGuard).
  ///
  /// Answers whether anything was bent. (ours)
  bool mend(const Gap& gap, GroupSet groups, MutablePoses made);

  static constexpr int kRounds = 24;

 private:
  /// A joint from the wrist up to below the elbow.
  struct Link {
    JointIndex joint = kNoJoint;
    std::ptrdiff_t translation = -1;  ///< of the pose; below 0 where the offset stands
    Eigen::Vector3f offset = Eigen::Vector3f::Zero();
  };
  struct Arm {
    Side side = Side::left;
    ArmJoints joints;
    std::vector<Link> forearm;  ///< the wrist first
    std::optional<HandPlaces> hand;
    FingerGuard fingers;
    JointChains chain;  ///< trunk, head, this arm and hand, and the other arm
    bool known() const noexcept { return hand.has_value(); }
  };
  /// How deep a part is, and the way out.
  struct Depth {
    float depth = 0;  ///< metres, at least 0
    Eigen::Vector3f out = Eigen::Vector3f::Zero();
    float along = 1;  ///< where on the forearm: 0 at the elbow, 1 at the wrist, and of a hand
  };
  /// Of the hand in the trunk's two sides, the head and the other hand, then of the forearm in the trunk's two sides.
  using Depths = std::array<Depth, 6>;
  /// How the arm is bent out of what it is in: one of both is nothing.
  struct Way {
    Eigen::Vector3f shift = Eigen::Vector3f::Zero();  ///< of the wrist, metres, model space
    float swivel = 0;                                 ///< of the elbow, radians
  };

  void look_at(PoseView pose, const Arm& arm, Depths& depths);
  Eigen::Vector3f forearm_of(PoseView pose, const Arm& arm) const;
  bool limit_wrist(const Arm& arm, MutablePoseView pose) const;
  void set_limits(const Gap& gap, Arm& arm);
  Way way_out(const Depth& deepest, bool of_hands, const Arm& arm);
  void bend(const Gap& gap, const Arm& arm, const Way& way, float peak, MutablePoses made);
  bool mend_arm(const Gap& gap, Arm& arm, bool with_fingers, MutablePoses made);

  const Skeleton* skeleton_;
  const SignerModel* signer_;
  std::array<Arm, 2> arms_;
  std::array<JointChains, 2> hands_;  ///< [Side] the hand and all above it
  // Of the gap and arm at hand:
  std::array<float, std::tuple_size_v<Depths>> allowed_{};
  WristLimits limits_;
  HandAxes axes_;  ///< in the space of the wrist's joint
  bool limited_ = false;
  Eigen::Vector3f passing_;  ///< from border to border, of this hand as the other sees it; metres, model space
  Eigen::Vector3f apart_;    ///< unit, the way that the hands were led apart at first; zero: they were not
  ModelPose pose_;
  HandPoints points_, other_;
  Eigen::Vector3f beside_ = Eigen::Vector3f::Zero();  ///< from the other palm to this one
  std::vector<Eigen::Quaternionf> best_;              ///< [frame][shoulder, elbow, wrist]
};

}  // namespace signweave
