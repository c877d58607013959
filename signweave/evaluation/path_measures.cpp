#include "signweave/evaluation/path_measures.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace signweave {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// Weights of the derivative of the given order at s = 0 of a cubic fitted to s = -left … right by least squares. The
/// unit is frame^-order.
std::vector<double> weights_of(std::int64_t left, std::int64_t right, std::int64_t order) {
  const auto count = static_cast<Eigen::Index>(left + right + 1);
  Eigen::Matrix<double, Eigen::Dynamic, 4> powers(count, 4);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double s = static_cast<double>(i - static_cast<Eigen::Index>(left));
    powers.row(i) << 1, s, s * s, s * s * s;
  }
  const Eigen::Matrix4d squares = powers.transpose() * powers;
  Eigen::Vector4d wanted = Eigen::Vector4d::Zero();
  wanted[static_cast<Eigen::Index>(order)] = 1;
  const Eigen::VectorXd weights = powers * squares.ldlt().solve(wanted);
  const double factorial = order == 3 ? 6 : order == 2 ? 2 : 1;
  std::vector<double> out(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = factorial * weights[static_cast<Eigen::Index>(i)];
  return out;
}

/// In place; the size is a power of two (Cooley and Tukey 1965).
void transform(std::vector<std::complex<double>>& values) {
  const std::size_t size = values.size();
  for (std::size_t i = 1, j = 0; i < size; ++i) {
    std::size_t bit = size >> 1;
    for (; (j & bit) != 0; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(values[i], values[j]);
  }
  for (std::size_t length = 2; length <= size; length *= 2) {
    const std::complex<double> step = std::polar(1.0, -2 * std::numbers::pi / static_cast<double>(length));
    for (std::size_t begin = 0; begin < size; begin += length) {
      std::complex<double> turn = 1;
      for (std::size_t i = begin; i < begin + length / 2; ++i) {
        const std::complex<double> odd = turn * values[i + length / 2];
        values[i + length / 2] = values[i] - odd;
        values[i] += odd;
        turn *= step;
      }
    }
  }
}

}  // namespace

PathFit::PathFit(FrameRate rate)
    : hertz_(rate.hertz()),
      half_(std::max<std::int64_t>(2, std::llround(std::floor(0.5 * kPathWindow.count() * rate.hertz() + 1e-3)))) {}

void PathFit::fit(std::span<const Eigen::Vector3f> path, std::int64_t order, std::vector<double>& out) const {
  out.clear();
  const auto count = static_cast<std::int64_t>(path.size());
  if (count < kLeastPoints) return;
  const std::int64_t size = std::min(window(), count);
  const double scale = std::pow(hertz_, static_cast<double>(order));
  std::vector<double> weights;
  std::int64_t fitted = -1;
  for (std::int64_t frame = 0; frame < count; ++frame) {
    const std::int64_t begin = std::clamp<std::int64_t>(frame - half_, 0, count - size);
    if (frame - begin != fitted) {
      fitted = frame - begin;
      weights = weights_of(fitted, size - 1 - fitted, order);
    }
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const Eigen::Vector3f& from = path[static_cast<std::size_t>(frame)];
    for (std::int64_t i = 0; i < size; ++i) {
      sum += weights[static_cast<std::size_t>(i)] * (path[static_cast<std::size_t>(begin + i)] - from).cast<double>();
    }
    out.push_back(order == 1 ? scale * sum.norm() : scale * scale * sum.squaredNorm());
  }
}

void PathFit::speeds(std::span<const Eigen::Vector3f> path, std::vector<double>& out) const {
  fit(path, 1, out);
}

void PathFit::squared_jerks(std::span<const Eigen::Vector3f> path, std::vector<double>& out) const {
  fit(path, 3, out);
}

double length_of(std::span<const Eigen::Vector3f> path) noexcept {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += static_cast<double>((path[i] - path[i - 1]).norm());
  return length;
}

double log_dimensionless_jerk(std::span<const double> speeds, std::span<const double> squared_jerks,
                              FrameRate rate) noexcept {
  if (speeds.empty() || speeds.size() != squared_jerks.size()) return kNotMeasured;
  const double step = rate.frame_time().count();
  const double peak = *std::max_element(speeds.begin(), speeds.end());
  double integral = 0;  // by the trapezoidal rule
  for (std::size_t i = 1; i < squared_jerks.size(); ++i) {
    integral += 0.5 * step * (squared_jerks[i - 1] + squared_jerks[i]);
  }
  const double duration = step * static_cast<double>(speeds.size() - 1);
  if (!(peak > 1e-6) || !(integral > 0)) return kNotMeasured;
  return -std::log(duration * duration * duration / (peak * peak) * integral);
}

double spectral_arc_length(std::span<const double> speeds, FrameRate rate) {
  constexpr double kHighest = 10;      // Hz
  constexpr double kThreshold = 0.05;  // relative to the largest amplitude
  if (speeds.size() < 2) return kNotMeasured;
  std::vector<std::complex<double>> spectrum(std::bit_ceil(speeds.size()) << 4);
  for (std::size_t i = 0; i < speeds.size(); ++i) spectrum[i] = speeds[i];
  transform(spectrum);
  const double hertz = rate.hertz() / static_cast<double>(spectrum.size());
  std::size_t end = 0;  // end of the used range
  double most = 0;
  std::vector<double> amplitudes;
  for (std::size_t i = 0; i <= spectrum.size() / 2; ++i) most = std::max(most, std::abs(spectrum[i]));
  if (!(most > 1e-9)) return kNotMeasured;
  for (std::size_t i = 0; i <= spectrum.size() / 2 && hertz * static_cast<double>(i) <= kHighest; ++i) {
    amplitudes.push_back(std::abs(spectrum[i]) / most);
    if (amplitudes.back() >= kThreshold) end = i + 1;
  }
  if (end < 2) return kNotMeasured;
  const double step = 1 / static_cast<double>(end - 1);  // frequency step relative to the used range
  double length = 0;
  for (std::size_t i = 1; i < end; ++i) length += std::hypot(step, amplitudes[i] - amplitudes[i - 1]);
  return -length;
}

}  // namespace signweave
