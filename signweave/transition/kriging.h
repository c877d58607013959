#pragma once

#include <cstddef>
#include <vector>

#include "signweave/transition/curves.h"

/// Internal to this module.
namespace signweave {

/// The best linear prediction of a joint's trajectory from the samples within kKrigingContext of both borders, with
/// trajectories modelled as random functions with an unknown mean and a Matérn covariance of smoothness 5/2 (ordinary
/// kriging; Stein, Interpolation of Spatial Data, 1999). At the borders it matches position, velocity and acceleration
/// as far as the samples can be trusted, which is less the noisier the captures are (Gap::noise_before and
/// noise_after).
class Kriging {
 public:
  static constexpr std::size_t kMostSamples = 10;  ///< per side

  enum class Weights {
    cached,  ///< `row` must be called for the frames of the gap, each at its time
    solved,  ///< always solved: `row` may be called for any time
  };

  /// Solves for a gap in O(samples³), once for all joints. The weights are cached for gaps of the same length, rate and
  /// context: the first kMostKept kinds of gaps, in 2.6 MB of static memory. `memory` is used for the solution and must
  /// outlive this object. Threads may construct objects concurrently.
  Kriging(const Gap& gap, const GapTime& time, std::vector<double>& memory, Weights weights = Weights::cached);

  std::size_t terms() const noexcept { return samples(); }
  void row(double t, std::int64_t frame, float* out) const noexcept;
  void coefficients(const Sides& sides, Eigen::Vector3f* out) const noexcept;
  void vectors(const GapScratch& scratch, double seconds, float* out) const noexcept;

 private:
  void solve(std::vector<double>& memory);
  std::size_t samples() const noexcept { return left_ + right_; }
  double time_of(std::size_t sample) const noexcept {
    return sample < left_ ? -static_cast<double>(sample * stride_) / hertz_
                          : seconds_ + static_cast<double>((sample - left_) * stride_) / hertz_;
  }

  double hertz_;
  double seconds_;
  double length_;
  double noise_;  ///< variance of the samples except the borders, in the covariance's unit
  std::size_t left_ = 0;
  std::size_t right_ = 0;
  std::size_t stride_ = 1;
  const double* inverse_ = nullptr;  ///< [sample][sample] inverse of the covariance
  const double* sums_ = nullptr;     ///< [sample] row sums of the inverse
  double* near_ = nullptr;           ///< [sample] covariance with the current time
  double total_ = 1;
  const float* rows_ = nullptr;  ///< [frame][sample] of cached weights; null: not cached
};

/// Trajectories of fingers: from one border's pose to the other's, with zero slope at both, plus a border's velocity
/// that decays within kRun of the gap. Kriged trajectories keep a velocity for longer than fingers do
/// (docs/evaluation.md). (ours)
struct FingerCurves {
  static constexpr double kRun = 0.7;
  BorderVelocity before, after;

  explicit FingerCurves(const Gap& gap) noexcept
      : before(static_cast<std::size_t>(context_frames(gap.before, gap.rate)), gap.rate.hertz()),
        after(static_cast<std::size_t>(context_frames(gap.after, gap.rate)), gap.rate.hertz()) {}

  std::size_t terms() const noexcept { return 4; }
  void row(double t, std::int64_t frame, float* out) const noexcept;
  void coefficients(const Sides& sides, Eigen::Vector3f* out) const noexcept;
  void vectors(const GapScratch& scratch, double seconds, float* out) const noexcept;
};

/// Splits a job into its fingers and everything else, and fills each part that is not empty.
template <class OfFingers, class OfOthers>
void fill_by_part(const GapJob& job, const OfFingers& of_fingers, const OfOthers& of_others) {
  constexpr GroupSet kFingerGroups{JointGroup::left_fingers, JointGroup::right_fingers};
  const auto part = [&](GroupSet groups, const auto& fill) {
    if (!groups.empty()) fill(GapJob{.gap = job.gap, .model = job.model, .groups = groups, .scratch = job.scratch});
  };
  part(job.groups.within(kFingerGroups), of_fingers);
  part(job.groups.without(kFingerGroups), of_others);
}

inline constexpr double kKrigingContext = 1.0 / 15;  ///< seconds
inline constexpr std::size_t kMostKept = 256;
inline constexpr std::int64_t kMostKeptFrames = 128;  ///< of one gap; longer gaps are not cached

}  // namespace signweave
