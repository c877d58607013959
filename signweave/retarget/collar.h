#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "signweave/motion/kinematics.h"
#include "signweave/retarget/character.h"
#include "signweave/retarget/rig_axes.h"

namespace signweave {

/// A character's collar bone that goes along with the arm, for sources whose own does not move: it rises with an arm
/// that rises, and comes forward with one that reaches forward or across.
class CharacterCollar {
 public:
  /// None where the character lacks collar bone or arm.
  static std::optional<CharacterCollar> make(const Character& character, const RigAxes& axes, Side side);

  /// `pose` has the turns that the source told. The turns of the joints from the collar bone to before the shoulder are
  /// changed, and the places of all that lies below.
  void lay(const Skeleton& skeleton, ModelPose& pose) const noexcept;

 private:
  float side_ = 1;                 ///< 1: left
  std::vector<JointIndex> bones_;  ///< from the collar bone to before the shoulder
  std::vector<JointIndex> below_;  ///< all below the collar bone, parents first
  JointIndex chest_ = kNoJoint;    ///< its parent
  JointIndex arm_ = kNoJoint;
  Eigen::Vector3f arm_axis_;  ///< along the upper arm at rest, unit
  Eigen::Quaternionf trunk_;  ///< the trunk's axes at rest
};

}  // namespace signweave
