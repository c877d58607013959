#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>

#include "signweave/core/time.h"
#include "signweave/features/capture_noise.h"
#include "signweave/motion/motion.h"
#include "signweave/transition/joint_groups.h"

namespace signweave {

/// Consecutive frames of a motion, borrowed.
struct PosesView {
  std::span<const Eigen::Quaternionf> rotations;  ///< [frame][joint]
  std::span<const Eigen::Vector3f> translations;  ///< [frame][translated joint]
  std::int64_t frames = 0;

  std::size_t joints() const noexcept { return frames > 0 ? rotations.size() / static_cast<std::size_t>(frames) : 0; }
  std::size_t moved() const noexcept { return frames > 0 ? translations.size() / static_cast<std::size_t>(frames) : 0; }
  PoseView pose(std::int64_t frame) const noexcept {
    const auto at = static_cast<std::size_t>(frame);
    return {rotations.subspan(at * joints(), joints()), translations.subspan(at * moved(), moved())};
  }
};
/// A view of frames of a motion, which must lie within it.
PosesView view_of(const Motion& motion, FrameRange frames) noexcept;

/// A range of frames that was not captured, with the frames on both sides of it. All views are of one skeleton.
/// Quaternions stay in one hemisphere from frame to frame on each side, but not across the gap. Everything is borrowed.
/// A method reads kContext of either side and changes none of its frames.
struct Gap {
  const Skeleton* skeleton = nullptr;
  const JointGroups* groups = nullptr;
  FrameRate rate;
  PosesView before;        ///< at least one frame; the last is the border
  PosesView after;         ///< at least one frame; the first is the border
  std::int64_t count = 0;  ///< frames to generate, at least one
  Seconds pause{0};        ///< the part of the gap in which nothing moves, soon after the left border
  /// Noise of the captures that the sides come from; null: unknown, and the sides are used as they are.
  const CaptureNoise* noise_before = nullptr;
  const CaptureNoise* noise_after = nullptr;

  PoseView left() const noexcept { return before.pose(before.frames - 1); }
  PoseView right() const noexcept { return after.pose(0); }
  /// Time from the left border to the right one.
  Seconds duration() const noexcept { return static_cast<double>(count + 1) * rate.frame_time(); }
};

/// How much of either side a method reads.
inline constexpr Seconds kContext{0.3};
/// kContext in frames, including both ends.
std::int64_t context_frames(FrameRate rate) noexcept;

}  // namespace signweave
