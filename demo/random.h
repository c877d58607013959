#pragma once

#include <cstdint>
#include <vector>

namespace signweave::demo {

/// Random numbers that are the same on every machine for one seed, unlike the standard library's distributions.
/// splitmix64 for the bits, the polar method for the normal distribution.
class Random {
 public:
  explicit Random(std::uint64_t seed) noexcept : state_(seed) {}

  std::uint64_t bits() noexcept;
  /// In [0, 1).
  double uniform() noexcept;
  double uniform(double low, double high) noexcept { return low + (high - low) * uniform(); }
  /// Mean 0, deviation 1.
  double normal() noexcept;

 private:
  std::uint64_t state_;
};

/// `count` numbers with exactly the given mean and standard deviation, none below `least`: drawn from a right-skewed
/// distribution, as durations are, then shifted and scaled. `least` must be well below `mean` (two deviations for more
/// than a handful of numbers, about one for fewer).
std::vector<double> sample_with(Random& random, std::size_t count, double mean, double deviation, double least);

/// Smooth noise over time: a sum of slow sines, so it never jumps and its speed is known.
class Wander {
 public:
  /// Frequencies lie in [low, high] hertz; the long-term deviation is 1.
  Wander(Random& random, double low, double high);
  double at(double seconds) const noexcept;

 private:
  static constexpr int kSines = 5;
  double frequency_[kSines];
  double phase_[kSines];
};

}  // namespace signweave::demo
