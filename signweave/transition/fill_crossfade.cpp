#include <algorithm>

#include "signweave/motion/blend.h"
#include "signweave/transition/fill.h"

namespace signweave {
namespace {

/// Frames by which a side continues beyond its border: limited by the frames that the side has, then it stands still.
std::int64_t reached(std::int64_t frames, const PosesView& side) noexcept {
  return std::min(frames, side.frames - 1);
}

/// A rotation reflected at the border's: as far beyond it as it was before it, so velocity is continuous.
Eigen::Quaternionf beyond(const Eigen::Quaternionf& border, const Eigen::Quaternionf& inside) noexcept {
  return (border * (inside.conjugate() * border)).normalized();
}

}  // namespace

/// What Performs does with two animations, adapted: each side continues past its border, and the first fades out while
/// the other fades in, linearly. Frames past the borders are unknown, so each side is reflected at its border (ours).
void fill_crossfade(const GapJob& job, MutablePoses out) noexcept {
  const Gap& gap = job.gap;
  const PoseView a = gap.left();
  const PoseView b = gap.right();
  const std::size_t joints = a.rotations.size();
  const std::size_t moved = a.translations.size();
  for (std::int64_t frame = 0; frame < gap.count; ++frame) {
    const auto at = static_cast<std::size_t>(frame);
    const float t = static_cast<float>(frame + 1) / static_cast<float>(gap.count + 1);
    const PoseView before = gap.before.pose(gap.before.frames - 1 - reached(frame + 1, gap.before));
    const PoseView after = gap.after.pose(reached(gap.count - frame, gap.after));
    for (std::size_t joint = 0; joint < joints; ++joint) {
      if (!job.groups.has(gap.groups->of[joint])) continue;
      const Eigen::Quaternionf from = beyond(a.rotations[joint], before.rotations[joint]);
      Eigen::Quaternionf turn = slerp(from, beyond(b.rotations[joint], after.rotations[joint]), t);
      const Eigen::Quaternionf& last = frame > 0 ? out.rotations[(at - 1) * joints + joint] : a.rotations[joint];
      if (turn.dot(last) < 0) turn.coeffs() *= -1;
      out.rotations[at * joints + joint] = turn;
    }
    for (std::size_t i = 0; i < moved; ++i) {
      if (!job.groups.has(gap.groups->of_translation[i])) continue;
      const Eigen::Vector3f from = 2 * a.translations[i] - before.translations[i];
      const Eigen::Vector3f to = 2 * b.translations[i] - after.translations[i];
      out.translations[at * moved + i] = from + t * (to - from);
    }
  }
}

}  // namespace signweave
