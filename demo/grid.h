#pragma once

#include <cmath>
#include <cstdint>

#include "signweave/core/time.h"

namespace signweave::demo {

/// Frames that fall on whole milliseconds: the number of frames per step, and its seconds.
struct Grid {
  std::int64_t frames = 1;
  double seconds = 0;
  /// The nearest number of steps to a duration in seconds.
  std::int64_t steps(double duration) const { return std::llround(duration / seconds); }
};

/// The finest grid of a rate. Throws Error{unsupported} for one whose steps are longer than 50 ms.
Grid grid_of(FrameRate rate);

}  // namespace signweave::demo
