#include "signweave/motion_db/bones.h"

#include <algorithm>
#include <cmath>

namespace signweave::motion_db {

namespace {

/// The rotation of every joint that carries something counts as if it moved a point this far away (metres), such as
/// flesh.
constexpr float kLeastLever = 0.01f;
/// The same for a joint that carries nothing.
constexpr float kBareLever = 0.05f;

}  // namespace

Bones::Bones(const Skeleton& skeleton) {
  const std::size_t joints = skeleton.joint_count();
  std::vector<float> length(joints, 0.0f);
  std::vector<float> ends(joints, 0.0f);  // the number of chain ends below
  std::vector<float> hanging(joints, 0.0f);
  middle.assign(joints, Eigen::Vector3f::Zero());
  below.resize(joints);
  tips.resize(joints);
  for (std::size_t i = 0; i < skeleton.tips().size(); ++i) {
    const Tip& tip = skeleton.tips()[i];
    const auto joint = static_cast<std::size_t>(tip.joint);
    tips[joint].push_back(i);
    length[joint] = std::max(length[joint], tip.offset.norm());
    ends[joint] += 1;
    middle[joint] += tip.offset;
    hanging[joint] += 1;
  }
  for (std::size_t i = joints; i-- > 0;) {
    ends[i] = std::max(ends[i], 1.0f);
    const JointIndex parent = skeleton.joints()[i].parent;
    if (parent == kNoJoint) continue;
    const auto at = static_cast<std::size_t>(parent);
    length[at] = std::max(length[at], skeleton.joints()[i].offset.norm());
    ends[at] += ends[i];
    middle[at] += skeleton.joints()[i].offset;
    hanging[at] += 1;
  }
  for (std::size_t i = 0; i < joints; ++i) {
    if (hanging[i] > 0) middle[i] /= hanging[i];
  }
  // If an error budget is shared by all chains through a joint, fewer bits are needed if joints of many chains get
  // finer steps.
  for (std::size_t i = 0; i < joints; ++i) {
    const float lever = std::max(length[i], length[i] > 0 ? kLeastLever : kBareLever);
    rotation_weight.push_back(0.5f / (lever * std::sqrt(ends[i])));
    translation_weight.push_back(1.0f / std::sqrt(ends[i]));
    carries.push_back(length[i] > 0);
    for (auto joint = static_cast<JointIndex>(i); joint != kNoJoint; joint = skeleton.joint(joint).parent) {
      below[static_cast<std::size_t>(joint)].push_back(static_cast<JointIndex>(i));
    }
  }
}

}  // namespace signweave::motion_db
