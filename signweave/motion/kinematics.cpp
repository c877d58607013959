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

JointChains::JointChains(const Skeleton& skeleton, std::span<const JointIndex> joints, JointIndex top)
    : top_(top), joint_count_(skeleton.joint_count()) {
  std::vector<bool> needed(joint_count_);
  for (JointIndex joint : joints) {
    for (; joint != kNoJoint && !needed[static_cast<std::size_t>(joint)]; joint = skeleton.joint(joint).parent) {
      needed[static_cast<std::size_t>(joint)] = true;
      if (joint == top) break;
    }
  }
  std::ptrdiff_t translation = 0;
  for (std::size_t i = 0; i < joint_count_; ++i) {
    const Joint& joint = skeleton.joints()[i];
    if (needed[i]) {
      const auto index = static_cast<JointIndex>(i);
      links_.push_back({index, joint.parent, joint.translated ? translation : -1, joint.offset});
      joints_.push_back(index);
    }
    if (joint.translated) ++translation;
  }
}

void JointChains::to_model_space(PoseView pose, ModelPose& out) const {
  out.rotations.resize(joint_count_);
  out.positions.resize(joint_count_);
  if (top_ != kNoJoint && !links_.empty()) {
    out.rotations[static_cast<std::size_t>(top_)].setIdentity();
    out.positions[static_cast<std::size_t>(top_)].setZero();
  }
  continue_below_top(pose, out);
}

void JointChains::continue_below_top(PoseView pose, ModelPose& out) const {
  for (const Link& link : links_) {
    const auto i = static_cast<std::size_t>(link.joint);
    const Eigen::Vector3f& local =
        link.translation < 0 ? link.offset : pose.translations[static_cast<std::size_t>(link.translation)];
    if (link.joint == top_) continue;
    if (link.parent == kNoJoint) {
      out.rotations[i] = pose.rotations[i];
      out.positions[i] = local;
    } else {
      const auto parent = static_cast<std::size_t>(link.parent);
      out.rotations[i] = out.rotations[parent] * pose.rotations[i];
      out.positions[i] = out.positions[parent] + out.rotations[parent] * local;
    }
  }
}

}  // namespace signweave
