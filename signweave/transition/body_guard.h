#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "signweave/features/contact.h"
#include "signweave/features/hand_points.h"
#include "signweave/motion/kinematics.h"
#include "signweave/transition/gap.h"

namespace signweave {

/// A made frame may lie so much deeper inside the body than the frames on both sides of its gap. Metres.
inline constexpr float kDepthAllowed = 0.003f;

/// Keeps hands that were made out of head and trunk. Made once per signer, it belongs to one thread; the second gap
/// allocates nothing.
class BodyGuard {
 public:
  /// Where the body's size is not known, or an arm, nothing is guarded.
  BodyGuard(const Skeleton& skeleton, const SignerModel& signer, const JointGroups& groups);

  /// Looks at the frames of a gap that were made for `groups`, whole poses. Where a hand goes deeper into the head or a
  /// side of the trunk than it is at either border, and kDepthAllowed, its way is bent outwards: the wrist is shifted
  /// where it is deepest, the shift fading out smoothly to nothing at both borders, so that position and velocity go on
  /// there. Elbow and shoulder follow (two-bone inverse kinematics), the hand keeps its orientation, the arm stays
  /// within reach. Repeated until no frame is too deep, at most kRounds times. Answers whether anything was bent.
  /// (ours)
  bool mend(const Gap& gap, GroupSet groups, MutablePoses made);

  static constexpr int kRounds = 12;

 private:
  struct Arm {
    JointIndex shoulder = kNoJoint;
    JointIndex elbow = kNoJoint;
    JointIndex wrist = kNoJoint;
    std::optional<HandPlaces> hand;
    bool known() const noexcept { return hand.has_value(); }
  };
  /// How deep a hand is, and the way out.
  struct Depth {
    float depth = 0;  ///< metres, at least 0
    Eigen::Vector3f out = Eigen::Vector3f::Zero();
  };

  using Depths = std::array<Depth, 3>;  ///< of the trunk's two sides, and the head

  Depths depths_at(PoseView pose, const Arm& arm);
  bool mend_arm(const Gap& gap, const Arm& arm, MutablePoses made);
  void shift(const Arm& arm, const Eigen::Vector3f& by, MutablePoseView pose);

  const Skeleton* skeleton_;
  const SignerModel* signer_;
  std::array<Arm, 2> arms_;
  JointChains chains_;
  ModelPose pose_;
  HandPoints points_;
};

}  // namespace signweave
