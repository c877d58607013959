#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace signweave {

/// Counts of values in bins of equal width: [begin + i · width, begin + (i + 1) · width), the last one closed.
struct Histogram {
  double begin = 0;
  double width = 0;                 ///< 1, 2 or 5 times a power of ten; 0 if there are no values
  std::vector<std::size_t> counts;  ///< [bin]; every value is counted
};

/// Descriptive statistics of some values, in their own unit.
struct Distribution {
  static constexpr std::array kQuantiles = {0.05, 0.10, 0.25, 0.50, 0.75, 0.90, 0.95};

  std::size_t count = 0;  ///< 0: nothing was measured and all other members are 0
  double mean = 0;
  double deviation = 0;  ///< standard deviation of the population: √(Σ(x − mean)² / count)
  double least = 0;
  double most = 0;
  std::array<double, kQuantiles.size()> quantiles{};  ///< interpolated linearly between the two nearest ranks
  /// The 95 % confidence interval of the mean, by Student's t: mean ± t · deviation / √(count − 1). Assumes independent
  /// values with a normally distributed mean. Both bounds equal the mean if count is 1.
  double mean_low = 0;
  double mean_high = 0;
  Histogram histogram;

  double median() const noexcept { return quantiles[3]; }
};

/// All values must be finite.
Distribution distribution_of(std::span<const double> values);

/// The critical value of Student's t with `degrees` degrees of freedom (at least 1) that is exceeded in either
/// direction with probability 5 %: 12.706 for 1, 1.96 for many. Accurate to 0.1 %.
double student_t_95(std::size_t degrees) noexcept;

}  // namespace signweave
