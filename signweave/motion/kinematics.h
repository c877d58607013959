#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <vector>

#include "signweave/motion/motion.h"

namespace signweave {

/// The joints of one pose in model space. Reusable, so that a loop over frames allocates only once.
struct ModelPose {
  std::vector<Eigen::Quaternionf> rotations;  ///< [joint], model_from_joint
  std::vector<Eigen::Vector3f> positions;     ///< [joint], metres, model space (Y up)
};

/// Forward kinematics: computes the pose's joints in model space. `out` is resized on first use only.
void to_model_space(const Skeleton& skeleton, PoseView pose, ModelPose& out);
ModelPose to_model_space(const Skeleton& skeleton, PoseView pose);

/// Forward kinematics of some joints and their ancestors, for callers that need only the hands, for example.
class JointChains {
 public:
  JointChains() = default;
  /// The joints must belong to the skeleton; their order and repetitions do not matter. If `top`, a common ancestor of
  /// all of them, is given, joints above it are left out and model space is that joint's own space.
  JointChains(const Skeleton& skeleton, std::span<const JointIndex> joints, JointIndex top = kNoJoint);

  /// The joints that are computed, ascending: the requested joints and their ancestors up to `top`.
  const JointSet& joints() const noexcept { return joints_; }
  /// Like the function above, but sets only these joints of `out`, to the same bits; `out` is resized on first use.
  void to_model_space(PoseView pose, ModelPose& out) const;
  /// The same for joints below a top that `out` already holds in model space: the top keeps its values.
  void continue_below_top(PoseView pose, ModelPose& out) const;

 private:
  struct Link {
    JointIndex joint = kNoJoint;
    JointIndex parent = kNoJoint;
    std::ptrdiff_t translation = -1;  ///< index in the pose; below 0 if the joint uses `offset`
    Eigen::Vector3f offset = Eigen::Vector3f::Zero();
  };
  std::vector<Link> links_;  ///< parents first
  JointIndex top_ = kNoJoint;
  JointSet joints_;
  std::size_t joint_count_ = 0;
};

/// The position of a tip in the model space of `pose`, metres.
inline Eigen::Vector3f position_of(const Tip& tip, const ModelPose& pose) {
  const auto joint = static_cast<std::size_t>(tip.joint);
  return pose.positions[joint] + pose.rotations[joint] * tip.offset;
}

}  // namespace signweave
