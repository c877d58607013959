#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "signweave/motion/motion.h"

namespace signweave {

/// Where every joint of one pose is. Reusable, so that a loop over frames allocates once.
struct ModelPose {
  std::vector<Eigen::Quaternionf> rotations;  ///< [joint], model_from_joint
  std::vector<Eigen::Vector3f> positions;     ///< [joint], metres, model space (Y up)
};

/// Forward kinematics: the pose's joints in model space. `out` is resized on first use only.
void to_model_space(const Skeleton& skeleton, PoseView pose, ModelPose& out);
ModelPose to_model_space(const Skeleton& skeleton, PoseView pose);

/// Where a tip is, in the model space of `pose`.
inline Eigen::Vector3f position_of(const Tip& tip, const ModelPose& pose) {
  const auto joint = static_cast<std::size_t>(tip.joint);
  return pose.positions[joint] + pose.rotations[joint] * tip.offset;
}

}  // namespace signweave
