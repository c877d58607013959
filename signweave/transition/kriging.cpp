#include "signweave/transition/kriging.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "signweave/transition/fill.h"

namespace signweave {
namespace {

/// Covariance at a distance in time, of variance 1.
double matern(double distance, double length) noexcept {
  const double r = std::sqrt(5.0) * std::abs(distance) / length;
  return (1 + r + r * r / 3) * std::exp(-r);
}

/// How long a way remembers itself: longer in longer gaps, whose movements are slower. Found on captured spans
/// (docs/evaluation.md). Below ten frames a second it is three frames, or they would tell nothing of each other.
double length_for(double seconds, double frame_time) noexcept {
  return std::max(0.3 * std::max(1.0, seconds), 3 * frame_time);
}

/// Variance of what the samples are off, in the covariance's own unit.
constexpr double kNoise = 1e-5;
constexpr double kBorderNoise = 1e-9;

}  // namespace

Kriging::Kriging(const Gap& gap, const GapTime& time, std::vector<double>& memory)
    : hertz_(gap.rate.hertz()), seconds_(time.seconds()), length_(length_for(seconds_, 1.0 / hertz_)) {
  const auto wanted = std::max<std::size_t>(3, static_cast<std::size_t>(std::llround(kKrigingContext * hertz_)) + 1);
  stride_ = (wanted + kMostSamples - 1) / kMostSamples;
  const auto count = [&](const PosesView& side) {
    const auto frames = static_cast<std::size_t>(context_frames(side, gap.rate));
    return std::min(kMostSamples, (std::min(frames, wanted) + stride_ - 1) / stride_);
  };
  left_ = count(gap.before);
  right_ = count(gap.after);
  const std::size_t n = samples();
  memory.resize(2 * n * n + 2 * n);
  const auto size = static_cast<Eigen::Index>(n);
  Eigen::Map<Eigen::MatrixXd> covariance(memory.data(), size, size);
  Eigen::Map<Eigen::MatrixXd> inverse(memory.data() + n * n, size, size);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = matern(time_of(i) - time_of(j), length_);
    }
    covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) +=
        i == 0 || i == left_ ? kBorderNoise : kNoise;
  }
  // In place: nothing is allocated.
  Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(covariance);
  inverse.setIdentity();
  factor.solveInPlace(inverse);
  double* sums = memory.data() + 2 * n * n;
  total_ = 0;
  for (std::size_t i = 0; i < n; ++i) {
    sums[i] = inverse.row(static_cast<Eigen::Index>(i)).sum();
    total_ += sums[i];
  }
  inverse_ = memory.data() + n * n;
  sums_ = sums;
  near_ = sums + n;
}

void Kriging::row(double t, std::int64_t, float* out) const noexcept {
  const double time = t * seconds_;
  const std::size_t n = samples();
  double told = 0;  // how much the samples tell: what is left is made up for by the unknown mean
  for (std::size_t i = 0; i < n; ++i) {
    near_[i] = matern(time - time_of(i), length_);
    told += sums_[i] * near_[i];
  }
  const double rest = (1 - told) / total_;
  for (std::size_t i = 0; i < n; ++i) {
    double weight = rest * sums_[i];
    for (std::size_t j = 0; j < n; ++j) weight += inverse_[i * n + j] * near_[j];
    out[i] = static_cast<float>(weight);
  }
}

void Kriging::coefficients(const Sides& sides, Eigen::Vector3f* out) const noexcept {
  for (std::size_t i = 0; i < left_; ++i) out[i] = sides.before[i * stride_];
  for (std::size_t i = 0; i < right_; ++i) out[left_ + i] = sides.after[i * stride_];
}

void fill_kriging(const GapJob& job, MutablePoses out) noexcept {
  const GapTime time(job.gap);
  fill_curves(job, out, Kriging(job.gap, time, job.scratch.numbers), time);
}

}  // namespace signweave
