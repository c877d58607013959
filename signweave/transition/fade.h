#pragma once

#include <algorithm>
#include <cstdint>

#include "signweave/transition/gap.h"

namespace signweave {

/// Relative time of a generated frame, from 0 at the left border to 1 at the right one.
inline float moment_of(const Gap& gap, std::int64_t frame) noexcept {
  return static_cast<float>(frame + 1) / static_cast<float>(gap.count + 1);
}

/// A bump that is 1 at `peak` and 0 at both ends of [0, 1], with zero slope at all three. An offset scaled by it leaves
/// pose and velocity at both borders unchanged.
inline float bump(float t, float peak) noexcept {
  const float x = t < peak ? t / peak : (1 - t) / (1 - peak);
  const float clamped = std::clamp(x, 0.0f, 1.0f);
  return clamped * clamped * (3 - 2 * clamped);
}

/// One frame of a gap.
inline MutablePoseView pose_at(const Skeleton& skeleton, MutablePoses made, std::int64_t frame) noexcept {
  const auto at = static_cast<std::size_t>(frame);
  const std::size_t joints = skeleton.joint_count();
  const std::size_t moved = skeleton.translation_count();
  return {made.rotations.subspan(at * joints, joints), made.translations.subspan(at * moved, moved)};
}

}  // namespace signweave
