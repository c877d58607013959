#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "signweave/motion/kinematics.h"
#include "signweave/retarget/character.h"
#include "signweave/retarget/rig_axes.h"

namespace signweave {

/// One leg of a character, laid so that the ankle comes to a place: bones of other lengths would let the foot slide.
class CharacterLeg {
 public:
  /// None where the character lacks the leg.
  static std::optional<CharacterLeg> make(const Character& character, const RigAxes& axes, Side side);

  /// Turns the joints from the hip to before the ankle, `pose` having the source's turns and the hip's place, so that
  /// the ankle is at `goal` (metres, model space) or as near as the leg reaches. The foot keeps its turn; how far thigh
  /// and shin are turned about themselves is told by knee, hips and toes.
  void lay(const Skeleton& skeleton, const Eigen::Vector3f& goal, ModelPose& pose) const noexcept;

 private:
  std::vector<JointIndex> upper_;  ///< from the hip to before the knee
  std::vector<JointIndex> lower_;  ///< from the knee to before the ankle
  std::vector<JointIndex> below_;  ///< all below the hip, parents first
  float upper_length_ = 0;         ///< metres
  float lower_length_ = 0;
  Eigen::Vector3f upper_axis_, lower_axis_;    ///< along the bones, at rest, unit
  Eigen::Vector3f upper_ahead_, lower_ahead_;  ///< to where the knee looks, at rest, unit
  JointIndex foot_ = kNoJoint;
  JointIndex pelvis_ = kNoJoint;               ///< the hip's parent
  Eigen::Vector3f foot_ahead_, pelvis_ahead_;  ///< to where toes and trunk look, at rest, unit
};

}  // namespace signweave
