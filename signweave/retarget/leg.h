#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "signweave/motion/kinematics.h"
#include "signweave/retarget/character.h"
#include "signweave/retarget/rig_axes.h"

namespace signweave {

/// One leg of a character, posed so that the ankle reaches a given position: with bones of other lengths the foot would
/// slide.
class CharacterLeg {
 public:
  /// Returns nullopt if the character lacks the leg.
  static std::optional<CharacterLeg> make(const Character& character, const RigAxes& axes, Side side);

  /// Rotates the joints from the hip to before the ankle so that the ankle is at `goal` (metres, model space) or as
  /// near as the leg reaches. On entry `pose` contains the source's rotations and the hip's position. The foot keeps
  /// its rotation; the twist of thigh and shin follows from knee, hips and toes.
  void solve(const Skeleton& skeleton, const Eigen::Vector3f& goal, ModelPose& pose) const noexcept;

 private:
  std::vector<JointIndex> upper_;  ///< from the hip to before the knee
  std::vector<JointIndex> lower_;  ///< from the knee to before the ankle
  std::vector<JointIndex> below_;  ///< all joints below the hip, parents first
  float upper_length_ = 0;         ///< metres
  float lower_length_ = 0;
  Eigen::Vector3f upper_axis_, lower_axis_;    ///< along the bones, at rest, unit vectors
  Eigen::Vector3f upper_ahead_, lower_ahead_;  ///< direction in which the knee points, at rest, unit vectors
  JointIndex foot_ = kNoJoint;
  JointIndex pelvis_ = kNoJoint;               ///< the hip's parent
  Eigen::Vector3f foot_ahead_, pelvis_ahead_;  ///< directions in which toes and trunk point, at rest, unit vectors
};

}  // namespace signweave
