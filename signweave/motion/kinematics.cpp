#include "signweave/motion/kinematics.h"

namespace signweave {

void to_model_space(const Skeleton& skeleton, PoseView pose, ModelPose& out) {
  const std::size_t joints = skeleton.joint_count();
  out.rotations.resize(joints);
  out.positions.resize(joints);
  std::size_t translation = 0;
  for (std::size_t i = 0; i < joints; ++i) {
    const Joint& joint = skeleton.joints()[i];
    const Eigen::Vector3f& local = joint.translated ? pose.translations[translation++] : joint.offset;
    if (joint.parent == kNoJoint) {
      out.rotations[i] = pose.rotations[i];
      out.positions[i] = local;
    } else {
      const auto parent = static_cast<std::size_t>(joint.parent);
      out.rotations[i] = out.rotations[parent] * pose.rotations[i];
      out.positions[i] = out.positions[parent] + out.rotations[parent] * local;
    }
  }
}

ModelPose to_model_space(const Skeleton& skeleton, PoseView pose) {
  ModelPose result;
  to_model_space(skeleton, pose, result);
  return result;
}

}  // namespace signweave
