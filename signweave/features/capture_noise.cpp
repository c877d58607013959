#include "signweave/features/capture_noise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "signweave/features/short_fit.h"

namespace signweave {
namespace {

/// The fit of one window of one joint: squares summed over the axes.
struct WindowFit {
  float moved = 0;  ///< sum of squares of the linear and quadratic terms
  float cubic = 0;  ///< square of the cubic term
  float rest = 0;   ///< residual sum of squares of the cubic fit
};

/// Returns whether one sum of squares is at most three times what noise alone would produce, judged by another; each
/// has the given number of degrees of freedom.
bool is_noise(float square, double numbers, float reference, double reference_numbers) noexcept {
  return static_cast<double>(square) / numbers <= 3 * static_cast<double>(reference) / reference_numbers;
}

/// Returns the noise estimated from windows of `frames` frames. Reorders the windows.
float noise_of(std::vector<WindowFit>& windows, std::size_t frames) {
  constexpr std::ptrdiff_t kLeast = 3;
  const double freedom = 3.0 * static_cast<double>(frames - ShortFit::kTerms);
  const auto begin = windows.begin();
  const auto resolved = std::partition(begin, windows.end(),
                                       [&](const WindowFit& one) { return is_noise(one.cubic, 3, one.rest, freedom); });
  auto end =
      std::partition(begin, resolved, [&](const WindowFit& one) { return is_noise(one.moved, 6, one.rest, freedom); });
  if (end - begin < kLeast && 2 * (resolved - begin) >= windows.end() - begin) end = resolved;
  if (end - begin < kLeast) return 0;
  const auto quarter = begin + (end - begin) / 4;
  std::nth_element(begin, quarter, end, [](const WindowFit& a, const WindowFit& b) { return a.rest < b.rest; });
  // The lower quartile of χ² with this number of degrees of freedom (Wilson and Hilferty 1931).
  const double part = 2 / (9 * freedom);
  const double usual = freedom * std::pow(1 - part - 0.6745 * std::sqrt(part), 3);
  return static_cast<float>(std::sqrt(static_cast<double>(quarter->rest) / usual));
}

}  // namespace

CaptureNoise capture_noise(const Motion& motion) {
  CaptureNoise noise;
  const std::size_t joints = motion.skeleton().joint_count();
  const std::size_t moved = motion.skeleton().translation_count();
  noise.rotations.resize(joints);
  noise.translations.resize(moved);
  const auto length = std::clamp<std::int64_t>(std::llround(kNoiseWindow * motion.rate().hertz()), 6, ShortFit::kMost);
  const std::int64_t windows = std::min(kMostWindows, motion.frame_count() / length);
  if (windows == 0) return noise;
  const ShortFit& fit = ShortFit::of(static_cast<std::size_t>(length));
  std::array<Eigen::Vector3f, ShortFit::kMost> path;
  std::vector<WindowFit> fits(static_cast<std::size_t>(windows));
  const auto measure = [&](auto value_at) {
    for (std::int64_t window = 0; window < windows; ++window) {
      const std::int64_t first = windows > 1 ? window * (motion.frame_count() - length) / (windows - 1) : 0;
      for (std::int64_t k = 0; k < length; ++k) path[static_cast<std::size_t>(k)] = value_at(first, first + k);
      const ShortFit::Terms terms = fit.terms_of({path.data(), static_cast<std::size_t>(length)});
      float all = 0;
      for (std::int64_t k = 0; k < length; ++k) all += path[static_cast<std::size_t>(k)].squaredNorm();
      WindowFit& one = fits[static_cast<std::size_t>(window)];
      one.moved = terms[1].squaredNorm() + terms[2].squaredNorm();
      one.cubic = terms[3].squaredNorm();
      one.rest = std::max(0.0f, all - terms[0].squaredNorm() - one.moved - one.cubic);
    }
    const float found = noise_of(fits, static_cast<std::size_t>(length));
    fits.resize(static_cast<std::size_t>(windows));
    return found;
  };
  for (std::size_t joint = 0; joint < joints; ++joint) {
    noise.rotations[joint] = measure([&](std::int64_t first, std::int64_t frame) -> Eigen::Vector3f {
      const Eigen::Quaternionf turn =
          motion.pose(first + length / 2).rotations[joint].conjugate() * motion.pose(frame).rotations[joint];
      return turn.vec() * (turn.w() < 0 ? -2.0f : 2.0f);  // small angles: twice the vector part
    });
  }
  for (std::size_t at = 0; at < moved; ++at) {
    noise.translations[at] = measure([&](std::int64_t first, std::int64_t frame) -> Eigen::Vector3f {
      return motion.pose(frame).translations[at] - motion.pose(first + length / 2).translations[at];
    });
  }
  return noise;
}

}  // namespace signweave
