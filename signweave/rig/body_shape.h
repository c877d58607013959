#pragma once

#include <Eigen/Core>
#include <vector>

#include "signweave/motion/kinematics.h"
#include "signweave/motion/motion.h"

namespace signweave {

/// The shape of a skeleton in some frames of a motion: lengths and branches, in metres.
struct BodyShape {
  std::vector<ModelPose> poses;  ///< at least one and at most 16 frames, spread evenly over the motion
  std::size_t middle = 0;        ///< index in `poses` of the pose in which lengths are measured
  std::vector<std::vector<JointIndex>> children;
  std::vector<float> bones;  ///< [joint] the distance from its parent; 0 for the root
  std::vector<float> reach;  ///< [joint] the longest path down from it, tips included
  std::vector<Tip> tips;     ///< [joint] its longest tip; joint kNoJoint if it has none, or none with a length
  float size = 1;            ///< approximately the stature, from the bones' lengths; above 0

  const ModelPose& pose() const { return poses[middle]; }
  const Eigen::Vector3f& place(JointIndex joint) const { return pose().positions[static_cast<std::size_t>(joint)]; }
  const std::vector<JointIndex>& below(JointIndex joint) const { return children[static_cast<std::size_t>(joint)]; }
  bool has_tip(JointIndex joint) const { return tips[static_cast<std::size_t>(joint)].joint != kNoJoint; }
  /// The length of the branch that starts with the bone to `joint`.
  float branch(JointIndex joint) const {
    return bones[static_cast<std::size_t>(joint)] + reach[static_cast<std::size_t>(joint)];
  }
};

/// The largest number of frames that `shape_of` reads, spread evenly.
inline constexpr std::int64_t kShapeFrames = 16;
/// The `i`th of these frames in a motion of `frames` frames.
constexpr std::int64_t shape_frame(std::int64_t i, std::int64_t frames) noexcept {
  // For an even number of frames the middle is the later one, as for a motion's middle frame.
  return frames < kShapeFrames ? i : i * frames / kShapeFrames;
}

/// The shape of a motion of at least one frame. Reads at most kShapeFrames frames, however long the motion is.
BodyShape shape_of(const Motion& motion);

/// True if `joint` is `above` or one of its descendants.
bool grows_from(const Skeleton& skeleton, JointIndex joint, JointIndex above);

}  // namespace signweave
