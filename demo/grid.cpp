#include "demo/grid.h"

#include <fmt/format.h>

#include <numeric>

#include "signweave/core/error.h"

namespace signweave::demo {

Grid grid_of(FrameRate rate) {
  const std::int64_t frames = rate.numerator / std::gcd(rate.numerator, 1000 * rate.denominator);
  const Grid grid{frames, static_cast<double>(frames) * rate.frame_time().count()};
  if (grid.seconds > 0.0501) {
    throw Error(
        ErrorCode::unsupported,
        fmt::format("--rate {}: its frames fall on whole milliseconds only every {:.0f} ms; take 100, 50 or 120",
                    to_string(rate), 1000 * grid.seconds));
  }
  return grid;
}

}  // namespace signweave::demo
