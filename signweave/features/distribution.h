#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace signweave {

/// How often values fall into steps of one width: [begin + i · width, begin + (i + 1) · width), the last one closed.
struct Histogram {
  double begin = 0;
  double width = 0;                 ///< 1, 2 or 5 times a power of ten; 0 where there is no value
  std::vector<std::size_t> counts;  ///< [step], all values are in one
};

/// What is told of some numbers, in their own unit.
struct Distribution {
  static constexpr std::array kQuantiles = {0.05, 0.10, 0.25, 0.50, 0.75, 0.90, 0.95};

  std::size_t count = 0;  ///< 0: nothing was measured and all else is 0
  double mean = 0;
  double deviation = 0;  ///< standard deviation of the population: √(Σ(x − mean)² / count)
  double least = 0;
  double most = 0;
  std::array<double, kQuantiles.size()> quantiles{};  ///< linear between the two nearest ranks
  /// The 95 % confidence interval of the mean, by Student's t: mean ± t · deviation / √(count − 1). It takes the
  /// numbers for independent and their mean for normally distributed. Both ends are the mean where count is 1.
  double mean_low = 0;
  double mean_high = 0;
  Histogram histogram;

  double median() const noexcept { return quantiles[3]; }
};

/// Over finite numbers.
Distribution distribution_of(std::span<const double> values);

/// The value that Student's t of so many degrees of freedom (at least 1) exceeds in either direction in 5 % of cases:
/// 12.706 for 1, 1.96 for many. Right to 0.1 %.
double student_t_95(std::size_t degrees) noexcept;

}  // namespace signweave
