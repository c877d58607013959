#include "signweave/evaluation/wrist_kinematics.h"

#include <algorithm>
#include <array>

namespace signweave {
namespace {

using Eigen::Vector3f;

/// The largest finite difference with the given weights, over start points [from, to].
template <std::size_t kSize>
double largest_change(std::span<const Vector3f> path, std::int64_t from, std::int64_t to,
                      const std::array<float, kSize>& weights) {
  double most = 0;
  for (std::int64_t begin = std::max<std::int64_t>(0, from);
       begin <= to && begin + static_cast<std::int64_t>(kSize) <= static_cast<std::int64_t>(path.size()); ++begin) {
    const auto first = static_cast<std::size_t>(begin);
    Vector3f sum = Vector3f::Zero();
    // Relative to a point, to avoid cancellation far from the origin.
    for (std::size_t i = 0; i < kSize; ++i) sum += weights[i] * (path[first + i] - path[first]);
    most = std::max(most, static_cast<double>(sum.norm()));
  }
  return most;
}

std::size_t fastest(std::span<const double> speeds) {
  return static_cast<std::size_t>(std::max_element(speeds.begin(), speeds.end()) - speeds.begin());
}

}  // namespace

WristKinematics WristMeter::measure(std::span<const Vector3f> path, std::int64_t left, std::int64_t count) {
  WristKinematics result;
  fit_.speeds(path, speeds_);
  fit_.squared_jerks(path, squared_jerks_);
  const auto first = static_cast<std::size_t>(left);
  const auto points = static_cast<std::size_t>(count + 2);
  const std::span<const Vector3f> gap = path.subspan(first, points);
  result.length = length_of(gap);
  result.chord = static_cast<double>((gap.back() - gap.front()).norm());
  const std::int64_t right = left + count + 1;
  constexpr std::array<float, 3> kSecond = {1, -2, 1};
  constexpr std::array<float, 4> kThird = {-1, 3, -3, 1};
  // All differences that span a seam between captured and generated points, at either border.
  result.velocity_jump =
      largest_change(path, left - 1, left, kSecond) + largest_change(path, right - 2, right - 1, kSecond);
  result.acceleration_jump =
      largest_change(path, left - 2, left, kThird) + largest_change(path, right - 3, right - 1, kThird);
  if (result.length < kStill || speeds_.empty()) return result;
  result.moves = true;
  const std::span<const double> speeds = std::span<const double>(speeds_).subspan(first, points);
  const std::size_t peak = fastest(speeds);
  const auto share = [&](std::size_t point) { return static_cast<double>(point) / static_cast<double>(count + 1); };
  result.peak_speed = speeds[peak];
  result.peak_time = share(peak);
  constexpr double kOnset = 0.1;
  std::size_t onset = 0;
  while (speeds[onset] < kOnset * speeds[peak]) ++onset;
  result.onset = share(onset);
  result.jerk = log_dimensionless_jerk(speeds_, squared_jerks_, rate_);
  result.arc_length = spectral_arc_length(speeds_, rate_);
  return result;
}

}  // namespace signweave
