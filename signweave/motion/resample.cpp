#include "signweave/motion/resample.h"

#include <algorithm>
#include <cmath>

#include "signweave/motion/blend.h"

namespace signweave {
namespace {

/// Positions of frames of one rate among those of another. Uses products of the rates' whole numbers, so that
/// coinciding frames coincide exactly.
struct FrameScale {
  double above = 1;
  double below = 1;

  FrameScale(FrameRate from, FrameRate to)
      : above(static_cast<double>(to.denominator) * static_cast<double>(from.numerator)),
        below(static_cast<double>(to.numerator) * static_cast<double>(from.denominator)) {}

  double at(std::int64_t frame) const noexcept {
    const double place = static_cast<double>(frame) * above / below;
    const double whole = std::round(place);
    return std::abs(place - whole) <= 1e-12 * std::max(1.0, whole) ? whole : place;
  }
};

}  // namespace

std::string_view name_of(RateMethod method) noexcept {
  return method == RateMethod::slerp ? "slerp" : "nearest";
}

Motion resampled(const Motion& motion, FrameRate rate, RateMethod method) {
  if (rate == motion.rate()) return motion;
  const std::int64_t frames = motion.frame_count();
  const FrameScale scale(motion.rate(), rate);
  std::int64_t count = 0;
  if (frames > 0) {
    count = static_cast<std::int64_t>(std::floor(static_cast<double>(frames - 1) * scale.below / scale.above)) + 2;
    while (scale.at(count - 1) > static_cast<double>(frames - 1)) --count;
  }
  Motion result(motion.shared_skeleton(), rate, count);
  std::vector<double> places;
  for (std::int64_t frame = 0; frame < count; ++frame) {
    const double place = scale.at(frame);
    places.push_back(method == RateMethod::slerp ? place : std::ceil(place - 0.5));
    sample(motion, places.back(), result.pose(frame));
  }
  keep_hemisphere(result);
  for (const ScalarTrack& track : motion.tracks()) {
    ScalarTrack values{.name = track.name, .values = {}};
    for (const double place : places) {
      const auto before = static_cast<std::size_t>(place);
      const std::size_t after = std::min(before + 1, track.values.size() - 1);
      const auto part = static_cast<float>(place - static_cast<double>(before));
      values.values.push_back(track.values[before] + part * (track.values[after] - track.values[before]));
    }
    result.add_track(std::move(values));
  }
  return result;
}

}  // namespace signweave
