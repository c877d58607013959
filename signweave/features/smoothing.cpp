#include "signweave/features/smoothing.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace signweave {

Smoother::Smoother(Seconds width, FrameRate rate, std::int64_t frames)
    : frames_(frames), hertz_(static_cast<float>(rate.hertz())) {
  // The tolerance is larger than the rounding error of a frame time printed in a file.
  constexpr auto kMostHalf = (kMostWindow - 1) / 2;
  const double half =
      std::clamp(std::floor(0.5 * width.count() * rate.hertz() + 1e-3), 1.0, static_cast<double>(kMostHalf));
  size_ = std::clamp<std::int64_t>(2 * static_cast<std::int64_t>(half) + 1, 1, std::max<std::int64_t>(frames, 1));
  // With s measured from the centre, 1, s and s² − mean(s²) are orthogonal over the window: no system to solve.
  const double middle = 0.5 * static_cast<double>(size_ - 1);
  double sum_2 = 0;
  for (std::int64_t i = 0; i < size_; ++i) sum_2 += std::pow(static_cast<double>(i) - middle, 2);
  const double mean_2 = sum_2 / static_cast<double>(size_);
  double sum_4 = 0;
  for (std::int64_t i = 0; i < size_; ++i) sum_4 += std::pow(std::pow(static_cast<double>(i) - middle, 2) - mean_2, 2);
  for (std::int64_t i = 0; i < size_; ++i) {
    const double s = static_cast<double>(i) - middle;
    slope_.push_back(size_ < 2 ? 0 : static_cast<float>(s / sum_2));
    curvature_.push_back(size_ < 3 ? 0 : static_cast<float>(2 * (s * s - mean_2) / sum_4));
  }
}

FrameRange Smoother::window(std::int64_t frame) const noexcept {
  const std::int64_t begin = std::clamp<std::int64_t>(frame - size_ / 2, 0, std::max<std::int64_t>(frames_ - size_, 0));
  return {begin, begin + size_};
}

FrameRange Smoother::window(FrameRange frames) const noexcept {
  return {window(frames.begin).begin, window(frames.end - 1).end};
}

PathDerivatives Smoother::at(std::int64_t frame, std::span<const Eigen::Vector3f> path,
                             std::int64_t first) const noexcept {
  const FrameRange seen = window(frame);
  assert(seen.begin >= first && seen.end - first <= static_cast<std::int64_t>(path.size()));
  const std::span<const Eigen::Vector3f> points =
      path.subspan(static_cast<std::size_t>(seen.begin - first), static_cast<std::size_t>(size_));
  // Relative to one of the points, so that positions far from the origin lose no precision.
  const Eigen::Vector3f& from = points[static_cast<std::size_t>(frame - seen.begin)];
  Eigen::Vector3f slope = Eigen::Vector3f::Zero();
  Eigen::Vector3f curvature = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f step = points[i] - from;
    slope += slope_[i] * step;
    curvature += curvature_[i] * step;
  }
  const float off_middle = static_cast<float>(frame - seen.begin) - 0.5f * static_cast<float>(size_ - 1);
  return {hertz_ * (slope + off_middle * curvature), hertz_ * hertz_ * curvature};
}

}  // namespace signweave
