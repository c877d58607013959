#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "signweave/motion/kinematics.h"
#include "signweave/retarget/character.h"
#include "signweave/retarget/rig_axes.h"

namespace signweave {

/// A character's clavicle that follows the arm, for sources whose own clavicle does not move: it rises with a rising
/// arm, and moves forward with an arm that reaches forward or across.
class CharacterCollar {
 public:
  /// Returns nullopt if the character lacks clavicle or arm.
  static std::optional<CharacterCollar> make(const Character& character, const RigAxes& axes, Side side);

  /// On entry `pose` contains the source's rotations. Changes the rotations of the joints from the clavicle to before
  /// the shoulder, and the positions of all joints below.
  void apply(const Skeleton& skeleton, ModelPose& pose) const noexcept;

 private:
  float side_ = 1;                 ///< 1: left
  std::vector<JointIndex> bones_;  ///< from the clavicle to before the shoulder
  std::vector<JointIndex> below_;  ///< all joints below the clavicle, parents first
  JointIndex chest_ = kNoJoint;    ///< its parent
  JointIndex arm_ = kNoJoint;
  Eigen::Vector3f arm_axis_;  ///< along the upper arm at rest, unit
  Eigen::Quaternionf trunk_;  ///< the trunk's axes at rest
};

}  // namespace signweave
