#pragma once

#include <vector>

#include "signweave/motion/motion.h"

namespace signweave {

/// The noise of a capture: the standard deviation of one frame about the smooth movement, per axis. All values are 0 if
/// there are too few frames to estimate it.
struct CaptureNoise {
  std::vector<float> rotations;     ///< [joint] radians
  std::vector<float> translations;  ///< [translated joint] metres
  friend bool operator==(const CaptureNoise&, const CaptureNoise&) = default;
};

/// Estimates the noise of every joint (ours; docs/synthesis.md). A cubic is fitted to at most kMostWindows windows of
/// kNoiseWindow, evenly distributed. The windows in which a joint is still are those in which neither the fit's
/// movement nor its cubic term exceeds what noise would produce. If there are none, and at least half of all windows
/// have no such cubic term, those windows are used: at such a frame rate, movement is at most quadratic within a
/// window. The noise is taken from the quarter of these windows with the smallest residuals, so that movement that no
/// fit follows is not counted as noise. Noise that the capture's own filter has spread over several frames is
/// underestimated.
CaptureNoise capture_noise(const Motion& motion);
inline constexpr double kNoiseWindow = 0.15;  ///< seconds; at least six frames
inline constexpr std::int64_t kMostWindows = 400;

}  // namespace signweave
