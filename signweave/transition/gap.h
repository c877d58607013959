#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>

#include "signweave/core/time.h"
#include "signweave/features/capture_noise.h"
#include "signweave/motion/motion.h"
#include "signweave/transition/joint_groups.h"

namespace signweave {

/// Neighbouring frames of a motion, borrowed.
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
/// Some frames of a motion, within it.
PosesView view_of(const Motion& motion, FrameRange frames) noexcept;

/// A stretch of frames that nobody captured, and what there is on both sides of it. Every view is of one skeleton;
/// quaternions keep one hemisphere from frame to frame on each side, not from one side to the other. All of it is
/// borrowed. A side is looked at as far as kContext, and no frame of it is changed.
struct Gap {
  const Skeleton* skeleton = nullptr;
  const JointGroups* groups = nullptr;
  FrameRate rate;
  PosesView before;        ///< at least one frame; the last is the border
  PosesView after;         ///< at least one frame; the first is the border
  std::int64_t count = 0;  ///< frames to be made, at least one
  Seconds pause{0};        ///< of the gap, in which nothing moves: soon after the left border
  /// Of the captures that the sides are from; null: not known, and the sides are taken as they are.
  const CaptureNoise* noise_before = nullptr;
  const CaptureNoise* noise_after = nullptr;

  PoseView left() const noexcept { return before.pose(before.frames - 1); }
  PoseView right() const noexcept { return after.pose(0); }
  /// Seconds from the left border to the right one.
  Seconds duration() const noexcept { return static_cast<double>(count + 1) * rate.frame_time(); }
};

/// As far as a method looks at either side.
inline constexpr Seconds kContext{0.3};
/// That in frames, inclusive of both ends.
std::int64_t context_frames(FrameRate rate) noexcept;

}  // namespace signweave
