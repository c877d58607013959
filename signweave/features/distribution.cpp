#include "signweave/features/distribution.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace signweave {
namespace {

constexpr std::size_t kMostSteps = 40;

/// Returns the number of the form 1, 2 or 5 times a power of ten that is nearest to `width` as a ratio, but not below
/// `least`.
double round_width(double width, double least) {
  const double power = std::pow(10.0, std::floor(std::log10(width)));
  double nearest = 0;
  for (const double factor : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    const double one = factor * power;
    if (one < least) continue;
    if (nearest == 0 || std::abs(std::log(one / width)) < std::abs(std::log(nearest / width))) nearest = one;
  }
  return nearest;
}

double quantile_of(std::span<const double> sorted, double part) {
  const double at = part * (static_cast<double>(sorted.size()) - 1.0);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (at - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

/// Bin width by Freedman and Diaconis 1981: 2 · (interquartile range) / ∛count, rounded, with a limited number of bins.
Histogram histogram_of(std::span<const double> sorted) {
  const double range = sorted.back() - sorted.front();
  const double between = quantile_of(sorted, 0.75) - quantile_of(sorted, 0.25);
  double width = 2 * between / std::cbrt(static_cast<double>(sorted.size()));
  const double least = range / static_cast<double>(kMostSteps - 1);
  width = std::max(width, least);
  if (!(width > 0)) width = std::max(std::abs(sorted.front()) * 0.1, 1e-6);  // all values are equal
  Histogram histogram;
  histogram.width = round_width(width, least);
  histogram.begin = std::floor(sorted.front() / histogram.width) * histogram.width;
  const double steps = std::floor((sorted.back() - histogram.begin) / histogram.width);
  histogram.counts.assign(static_cast<std::size_t>(steps) + 1, 0);
  for (const double value : sorted) {
    const auto step = static_cast<std::size_t>((value - histogram.begin) / histogram.width);
    ++histogram.counts[std::min(step, histogram.counts.size() - 1)];
  }
  return histogram;
}

}  // namespace

double student_t_95(std::size_t degrees) noexcept {
  assert(degrees > 0);
  constexpr std::array kFew = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228};
  if (degrees <= kFew.size()) return kFew[degrees - 1];
  // Cornish and Fisher's expansion about the normal distribution.
  constexpr double z = 1.959963985;
  const double v = static_cast<double>(degrees);
  const double z2 = z * z;
  return z * (1 + (z2 + 1) / (4 * v) + ((5 * z2 + 16) * z2 + 3) / (96 * v * v) +
              (((3 * z2 + 19) * z2 + 17) * z2 - 15) / (384 * v * v * v));
}

Distribution distribution_of(std::span<const double> values) {
  Distribution result;
  result.count = values.size();
  if (values.empty()) return result;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const auto count = static_cast<double>(sorted.size());
  result.mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / count;
  double squares = 0;
  for (const double value : sorted) squares += (value - result.mean) * (value - result.mean);
  result.deviation = std::sqrt(squares / count);
  result.least = sorted.front();
  result.most = sorted.back();
  for (std::size_t i = 0; i < result.quantiles.size(); ++i) {
    result.quantiles[i] = quantile_of(sorted, Distribution::kQuantiles[i]);
  }
  const double half = sorted.size() < 2 ? 0 : student_t_95(sorted.size() - 1) * result.deviation / std::sqrt(count - 1);
  result.mean_low = result.mean - half;
  result.mean_high = result.mean + half;
  result.histogram = histogram_of(sorted);
  return result;
}

}  // namespace signweave
