#pragma once

#include <Eigen/Core>
#include <vector>

#include "signweave/motion/kinematics.h"
#include "signweave/motion/motion.h"

namespace signweave {

/// A skeleton as it stands in some frames of a motion: lengths, branches. Metres.
struct BodyShape {
  std::vector<ModelPose> poses;  ///< some frames, at most 16, evenly over the motion; at least one
  std::size_t middle = 0;        ///< of `poses`: the one that lengths are measured in
  std::vector<std::vector<JointIndex>> children;
  std::vector<float> bones;  ///< [joint] from its parent to it; 0 for the root
  std::vector<float> reach;  ///< [joint] the longest way down from it, tips included
  std::vector<Tip> tips;     ///< [joint] its longest tip; its joint kNoJoint where there is none, or one of no length
  float size = 1;            ///< about the stature, told from the bones' lengths; above 0

  const ModelPose& pose() const { return poses[middle]; }
  const Eigen::Vector3f& place(JointIndex joint) const { return pose().positions[static_cast<std::size_t>(joint)]; }
  const std::vector<JointIndex>& below(JointIndex joint) const { return children[static_cast<std::size_t>(joint)]; }
  bool has_tip(JointIndex joint) const { return tips[static_cast<std::size_t>(joint)].joint != kNoJoint; }
  /// The length of the branch that begins with the bone to `joint`.
  float branch(JointIndex joint) const {
    return bones[static_cast<std::size_t>(joint)] + reach[static_cast<std::size_t>(joint)];
  }
};

/// Frames that `shape_of` looks at, at most, spread evenly.
inline constexpr std::int64_t kShapeFrames = 16;
/// The `i`th of them, of a motion of so many.
constexpr std::int64_t shape_frame(std::int64_t i, std::int64_t frames) noexcept {
  // The middle one of an even number is the later, as for a motion's middle frame.
  return frames < kShapeFrames ? i : i * frames / kShapeFrames;
}

/// Of a motion of at least one frame. Reads a few frames, however long the motion.
BodyShape shape_of(const Motion& motion);

/// Whether `joint` is `above` or grows from it.
bool grows_from(const Skeleton& skeleton, JointIndex joint, JointIndex above);

}  // namespace signweave
