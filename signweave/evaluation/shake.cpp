#include "signweave/evaluation/shake.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace signweave {
namespace {

/// Distance from a joint to its descendant wrist in the rest pose, metres; 0 if there is none.
double reach_of(const Skeleton& skeleton, JointIndex joint, const JointGroups& groups) {
  for (const JointIndex wrist : groups.wrists) {
    Eigen::Vector3f offset = Eigen::Vector3f::Zero();
    for (JointIndex at = wrist; at != kNoJoint; at = skeleton.joints()[static_cast<std::size_t>(at)].parent) {
      if (at == joint) return static_cast<double>(offset.norm());
      offset += skeleton.joints()[static_cast<std::size_t>(at)].offset;
    }
  }
  return 0;
}

}  // namespace

void shake(EvaluatedMotion& recording, double metres, std::uint64_t seed) {
  auto shaken = std::make_shared<Motion>(recording.motion);
  const Skeleton& skeleton = shaken->skeleton();
  std::mt19937_64 random(seed ^ static_cast<std::uint64_t>(shaken->frame_count()));
  std::normal_distribution<float> normal;
  for (std::size_t joint = 0; joint < skeleton.joint_count(); ++joint) {
    const JointRole role = recording.groups.roles[joint];
    if (role != JointRole::shoulder && role != JointRole::elbow) continue;
    const double reach = reach_of(skeleton, static_cast<JointIndex>(joint), recording.groups);
    if (reach <= 0) continue;
    const auto deviation = static_cast<float>(metres / (std::sqrt(2.0) * reach));
    for (std::int64_t frame = 0; frame < shaken->frame_count(); ++frame) {
      const Eigen::Vector3f half(normal(random), normal(random), normal(random));
      Eigen::Quaternionf turn(1, 0, 0, 0);
      turn.vec() = 0.5f * deviation * half;
      Eigen::Quaternionf& value = shaken->pose(frame).rotations[joint];
      value = (value * turn).normalized();
    }
  }
  recording.noise = capture_noise(*shaken);
  recording.shaken = std::move(shaken);
}

}  // namespace signweave
