#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace signweave {

/// Index of a joint in its skeleton.
using JointIndex = int;
inline constexpr JointIndex kNoJoint = -1;

/// One node of a skeleton.
struct Joint {
  std::string name;                                  ///< as in the file, UTF-8; not necessarily unique
  JointIndex parent = kNoJoint;                      ///< smaller than the joint's own index; kNoJoint for the root
  Eigen::Vector3f offset = Eigen::Vector3f::Zero();  ///< from the parent, metres, parent's space
  bool translated = false;                           ///< has a translation per frame, which replaces `offset`
  friend bool operator==(const Joint&, const Joint&) = default;
};

/// The end of a chain (BVH's End Site): a point that moves with its joint. It is not a joint, so no packet contains it.
struct Tip {
  JointIndex joint = kNoJoint;
  Eigen::Vector3f offset = Eigen::Vector3f::Zero();  ///< from the joint, metres, joint's space
  friend bool operator==(const Tip&, const Tip&) = default;
};

/// A set of joints, ascending. An empty set means every joint.
using JointSet = std::vector<JointIndex>;

/// The joint hierarchy shared by all poses of a motion (the paper's "bind pose", section 4.1). Immutable, so several
/// threads and motions may share one through shared_ptr<const Skeleton>.
class Skeleton {
 public:
  Skeleton() = default;
  /// Parents must come before their children, with joint 0 as the only root; tips must refer to joints; 1 to 65,535
  /// joints. Throws Error{bad_input} otherwise.
  Skeleton(std::vector<Joint> joints, std::vector<Tip> tips);

  std::span<const Joint> joints() const noexcept { return joints_; }
  std::span<const Tip> tips() const noexcept { return tips_; }
  std::size_t joint_count() const noexcept { return joints_.size(); }
  const Joint& joint(JointIndex index) const noexcept { return joints_[static_cast<std::size_t>(index)]; }

  /// The translated joints, ascending. The i-th one has translation i of each pose.
  std::span<const JointIndex> translated_joints() const noexcept { return translated_; }
  std::size_t translation_count() const noexcept { return translated_.size(); }
  /// The index of a joint's translation in a pose; empty if it has none.
  std::optional<std::size_t> translation_of(JointIndex joint) const noexcept;

  /// The first joint with this name, if any.
  std::optional<JointIndex> find(std::string_view name) const noexcept;

  friend bool operator==(const Skeleton& a, const Skeleton& b) { return a.joints_ == b.joints_ && a.tips_ == b.tips_; }

 private:
  std::vector<Joint> joints_;
  std::vector<Tip> tips_;
  std::vector<JointIndex> translated_;
};

/// Empty if motions of the two skeletons may be joined (same joint names, parents and translated joints in the same
/// order; offsets and tips may differ); otherwise one line that names the first joint that differs.
std::optional<std::string> difference(const Skeleton& a, const Skeleton& b);

}  // namespace signweave
