#include "signweave/features/phase_signals.h"

#include <algorithm>
#include <cmath>

namespace signweave {

Signal smoothed(const Signal& signal, double sigma) {
  const auto radius = static_cast<std::ptrdiff_t>(std::lround(4.0 * sigma));
  std::vector<float> weights(static_cast<std::size_t>(2 * radius + 1));
  float sum = 0;
  for (std::ptrdiff_t i = -radius; i <= radius; ++i) {
    const double x = static_cast<double>(i) / sigma;
    sum += weights[static_cast<std::size_t>(i + radius)] = static_cast<float>(std::exp(-0.5 * x * x));
  }
  for (float& weight : weights) weight /= sum;
  const auto count = static_cast<std::ptrdiff_t>(signal.size());
  Signal padded(signal.size() + 2 * static_cast<std::size_t>(radius));
  for (std::ptrdiff_t i = 0; i < std::ssize(padded); ++i) {
    padded[static_cast<std::size_t>(i)] =
        signal[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i - radius, 0, count - 1))];
  }
  Signal result(signal.size(), 0.0F);
  // Loops over weights outside and frames inside, so that the inner loop is a plain sum of two arrays.
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const float weight = weights[k];
    const float* const from = padded.data() + k;
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += weight * from[i];
  }
  return result;
}

Path smoothed(const Path& path, double sigma) {
  return {smoothed(path[0], sigma), smoothed(path[1], sigma), smoothed(path[2], sigma)};
}

Signal median_of_five(const Signal& signal) {
  const auto count = static_cast<std::ptrdiff_t>(signal.size());
  Signal result(signal.size());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    std::array<float, 5> window;
    for (std::ptrdiff_t k = 0; k < 5; ++k) {
      window[static_cast<std::size_t>(k)] =
          signal[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i + k - 2, 0, count - 1))];
    }
    std::nth_element(window.begin(), window.begin() + 2, window.end());
    result[static_cast<std::size_t>(i)] = window[2];
  }
  return result;
}

Signal difference(const Signal& signal) {
  const std::size_t count = signal.size();
  Signal result(count, 0.0F);
  if (count < 2) return result;
  result[0] = signal[1] - signal[0];
  result[count - 1] = signal[count - 1] - signal[count - 2];
  for (std::size_t i = 1; i + 1 < count; ++i) result[i] = 0.5F * (signal[i + 1] - signal[i - 1]);
  return result;
}

Signal speed_of(const Path& path) {
  const Path change = {difference(path[0]), difference(path[1]), difference(path[2])};
  Signal result(path[0].size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = static_cast<float>(kSegmenterRate) * std::hypot(change[0][i], change[1][i], change[2][i]);
  }
  return result;
}

float quantile(std::vector<float> values, double q) {
  if (values.empty()) return 0;
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace signweave
