#include "demo/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace signweave::demo {

std::uint64_t Random::bits() noexcept {
  state_ += 0x9e3779b97f4a7c15ull;
  std::uint64_t mixed = state_;
  mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9ull;
  mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebull;
  return mixed ^ (mixed >> 31);
}

double Random::uniform() noexcept {
  return static_cast<double>(bits() >> 11) * 0x1.0p-53;
}

double Random::normal() noexcept {
  for (;;) {
    const double x = uniform(-1, 1);
    const double y = uniform(-1, 1);
    const double square = x * x + y * y;
    if (square > 0 && square < 1) return x * std::sqrt(-2 * std::log(square) / square);
  }
}

std::vector<double> sample_with(Random& random, std::size_t count, double mean, double deviation, double least) {
  std::vector<double> values(count, mean);
  if (count < 2) return values;
  for (double& value : values) value = std::exp(0.3 * random.normal());
  // Raising the values below `least` changes mean and deviation again, so the two steps alternate.
  for (int round = 0; round < 200; ++round) {
    const double size = static_cast<double>(count);
    const double middle = std::accumulate(values.begin(), values.end(), 0.0) / size;
    double square = 0;
    for (const double value : values) square += (value - middle) * (value - middle);
    const double spread = std::sqrt(square / size);
    bool low = false;
    for (double& value : values) {
      value = mean + (value - middle) * (deviation / spread);
      low = low || value < least;
    }
    if (!low) break;
    for (double& value : values) value = std::max(value, least + 0.05 * deviation);
  }
  return values;
}

Wander::Wander(Random& random, double low, double high) {
  for (int i = 0; i < kSines; ++i) {
    frequency_[i] = random.uniform(low, high) * 2 * std::numbers::pi;
    phase_[i] = random.uniform(0, 2 * std::numbers::pi);
  }
}

double Wander::at(double seconds) const noexcept {
  double sum = 0;
  for (int i = 0; i < kSines; ++i) sum += std::sin(frequency_[i] * seconds + phase_[i]);
  return sum * std::sqrt(2.0 / kSines);
}

}  // namespace signweave::demo
