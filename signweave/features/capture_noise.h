#pragma once

#include <vector>

#include "signweave/motion/motion.h"

namespace signweave {

/// How much a capture shakes where nothing moves: the standard deviation of one frame about the smooth movement, on
/// each axis. All of it is 0 where there are too few frames to tell.
struct CaptureNoise {
  std::vector<float> rotations;     ///< [joint] radians
  std::vector<float> translations;  ///< [translated joint] metres
  friend bool operator==(const CaptureNoise&, const CaptureNoise&) = default;
};

/// At most kMostWindows windows of kNoiseWindow, evenly from all, are fitted by a cubic. A joint's still frames are the
/// windows in which neither the fit's movement nor its cubic term is more than noise would make of it; where there are
/// none, and at least half of all windows have no such cubic term, those serve: at such a rate movement shows no more
/// than a quadratic. The noise is taken from the quarter of them that are off least from their fits, so that movement
/// which no fit follows is not taken for noise. Noise that the capture's own filter has spread over several frames is
/// underestimated. (ours; docs/synthesis.md)
CaptureNoise capture_noise(const Motion& motion);
inline constexpr double kNoiseWindow = 0.15;  ///< seconds; six frames at least
inline constexpr std::int64_t kMostWindows = 400;

}  // namespace signweave
