#pragma once

#include <cstddef>
#include <vector>

#include "signweave/transition/curves.h"

/// Inside this module only.
namespace signweave {

/// The best linear guess of a joint's way from what lies within kKrigingContext of both borders, if ways are random
/// functions with an unknown mean and a Matérn covariance of smoothness 5/2 (ordinary kriging; Stein, Interpolation of
/// Spatial Data, 1999): it has place, velocity and acceleration at the borders as far as the samples can be trusted,
/// which is less the more the captures shake (Gap::noise_before and noise_after).
class Kriging {
 public:
  static constexpr std::size_t kMostSamples = 10;  ///< a side

  enum class Weights {
    kept,  ///< `row` must be asked for the frames of the gap, each at its time
    anew,  ///< solved in any case: `row` may be asked for any moment
  };

  /// Solves for a gap; O(samples³), once for all joints, and not again for gaps of the same length, rate and context:
  /// the weights of the first kMostKept kinds of gaps are kept by the program (in 2.6 MB, which it never allocates).
  /// `memory` is used for it and must outlive this. Threads may construct them at the same time.
  Kriging(const Gap& gap, const GapTime& time, std::vector<double>& memory, Weights weights = Weights::kept);

  std::size_t terms() const noexcept { return samples(); }
  void row(double t, std::int64_t frame, float* out) const noexcept;
  void coefficients(const Sides& sides, Eigen::Vector3f* out) const noexcept;
  void ways(const GapScratch& scratch, double seconds, float* out) const noexcept;

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
  double noise_;  ///< variance of the samples but the borders, in the covariance's own unit
  std::size_t left_ = 0;
  std::size_t right_ = 0;
  std::size_t stride_ = 1;
  const double* inverse_ = nullptr;  ///< [sample][sample] of the covariance
  const double* sums_ = nullptr;     ///< [sample] row sums of it
  double* near_ = nullptr;           ///< [sample] covariance with the moment looked at
  double total_ = 1;
  const float* rows_ = nullptr;  ///< [frame][sample] of weights that are kept; null: they are not
};

/// How fingers go: from one border's pose to the other's, level at both; a border's velocity goes on and is used up
/// within kRun of the gap. Kriged ways go on with a velocity for longer than fingers do (docs/evaluation.md). (ours)
struct FingerCurves {
  static constexpr double kRun = 0.7;
  BorderVelocity before, after;

  explicit FingerCurves(const Gap& gap) noexcept
      : before(static_cast<std::size_t>(context_frames(gap.before, gap.rate)), gap.rate.hertz()),
        after(static_cast<std::size_t>(context_frames(gap.after, gap.rate)), gap.rate.hertz()) {}

  std::size_t terms() const noexcept { return 4; }
  void row(double t, std::int64_t frame, float* out) const noexcept;
  void coefficients(const Sides& sides, Eigen::Vector3f* out) const noexcept;
  void ways(const GapScratch& scratch, double seconds, float* out) const noexcept;
};

/// A job in two: that of its fingers and that of everything else, where there are such.
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
inline constexpr std::int64_t kMostKeptFrames = 128;  ///< of one gap; of longer ones nothing is kept

}  // namespace signweave
