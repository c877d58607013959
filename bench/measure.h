#pragma once

// Shared by all benchmarks: measures an action and its yardstick in turns, within one run, and prints a line "name
// value unit yardstick ratio goal". Machines are noisy: single figures mean little, but ratios of interleaved medians
// are stable.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <vector>

namespace signweave::bench {

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Seconds per call of `action`, as the mean of `calls`.
template <typename Action>
double seconds_of(Action&& action, int calls = 1) {
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < calls; ++i) action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / calls;
}

/// Medians over the rounds, seconds; the ratio is the median of the rounds' own ratios.
struct Compared {
  double ours = 0;
  double yardstick = 0;
  double ratio = 0;
};

/// Measures both in turns, `rounds` times, after one uncounted round.
template <typename Ours, typename Yardstick>
Compared compare(int rounds, Ours&& ours, Yardstick&& yardstick, int calls = 1) {
  std::vector<double> a, b, ratios;
  for (int round = -1; round < rounds; ++round) {
    const double mine = seconds_of(ours, calls);
    const double other = seconds_of(yardstick, calls);
    if (round < 0) continue;
    a.push_back(mine);
    b.push_back(other);
    ratios.push_back(mine / other);
  }
  return {median(a), median(b), median(ratios)};
}

/// Keeps the compiler from discarding the computation of `value`.
template <typename Value>
inline void keep(const Value& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

/// Prints one result. `goal` is a condition on the ratio such as "<= 1.5", or "-".
inline void print(std::string_view name, double value, std::string_view unit, double yardstick, double ratio,
                  std::string_view goal) {
  fmt::print("{} {:.4g} {} {:.4g} {:.3g} {}\n", name, value, unit, yardstick, ratio, goal);
  std::fflush(stdout);
}
inline void print(std::string_view name, double scale, std::string_view unit, const Compared& compared,
                  std::string_view goal) {
  print(name, compared.ours * scale, unit, compared.yardstick * scale, compared.ratio, goal);
}

/// A folder of this benchmark, initially empty and removed at the end.
class Folder {
 public:
  explicit Folder(std::string_view name)
      : path_(std::filesystem::temp_directory_path() / fmt::format("signweave_bench_{}", name)) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace signweave::bench
