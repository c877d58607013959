#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <span>
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

/// Forward kinematics of some joints and all above them: for who looks at the hands alone.
class JointChains {
 public:
  JointChains() = default;
  /// The joints must be of the skeleton; their order and repetitions do not matter. With a `top`, a joint above all of
  /// them, what is above it is left out and model space is that joint's own.
  JointChains(const Skeleton& skeleton, std::span<const JointIndex> joints, JointIndex top = kNoJoint);

  /// The joints that are computed, ascending: those asked for and all above them, up to `top`.
  const JointSet& joints() const noexcept { return joints_; }
  /// As the function above, but only these joints of `out` are set, to the same bits; `out` is resized on first use.
  void to_model_space(PoseView pose, ModelPose& out) const;
  /// The same for joints below a top that `out` already has in model space: it stays, and they follow.
  void continue_below_top(PoseView pose, ModelPose& out) const;

 private:
  struct Link {
    JointIndex joint = kNoJoint;
    JointIndex parent = kNoJoint;
    std::ptrdiff_t translation = -1;  ///< of the pose; below 0 where the offset stands
    Eigen::Vector3f offset = Eigen::Vector3f::Zero();
  };
  std::vector<Link> links_;  ///< parents first
  JointIndex top_ = kNoJoint;
  JointSet joints_;
  std::size_t joint_count_ = 0;
};

/// Where a tip is, in the model space of `pose`.
inline Eigen::Vector3f position_of(const Tip& tip, const ModelPose& pose) {
  const auto joint = static_cast<std::size_t>(tip.joint);
  return pose.positions[joint] + pose.rotations[joint] * tip.offset;
}

}  // namespace signweave
