#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "signweave/core/bytes.h"

namespace signweave {

/// The residual motion of a corpus's wrists over a gap, relative to the most likely trajectory: a Gaussian process on a
/// few vectors seen at the borders (traits), weighted by quantities derived from them that are invariant to rotation
/// (gates). Rotating the borders rotates the result. (after the residuals of Δ-Interpolator, Oreshkin et al. 2022; the
/// kernel is ours)
struct ResidualModel {
  /// Vectors in arm lengths: the displacement from border to border; the velocities at both borders, times the
  /// duration; the accelerations at both, times its square.
  static constexpr std::size_t kTraits = 5;
  /// Logarithms of the magnitudes of the first three, the cosines between them, the logarithm of the duration.
  static constexpr std::size_t kGates = 7;
  /// Number of basis functions of time in a residual, see residual_bends.
  static constexpr std::size_t kBends = 6;
  using Traits = std::array<Eigen::Vector3f, kTraits>;
  using Gates = std::array<float, kGates>;
  using Bends = std::array<Eigen::Vector3f, kBends>;

  struct Centre {
    Gates gates{};                                ///< standardised
    std::array<float, kTraits * kBends> weights;  ///< [trait][bend]
  };

  Gates gate_mean{};
  Gates gate_scale{};
  std::array<float, kTraits> trait_scale{};
  std::vector<Centre> centres;  ///< empty: nothing was learned

  // Performance on movements of recordings (or signers) that it was not trained on.
  std::uint64_t movements = 0;   ///< number of movements evaluated
  std::uint64_t recordings = 0;  ///< number of their recordings
  std::uint64_t folds = 0;       ///< number of folds left out in turn; 0: too little data to compare
  bool by_signer = false;        ///< true: folds are signers; false: recordings
  float mean_ratio = 1;    ///< ratio of the mean wrist error to that of the most likely trajectory, averaged over folds
                           ///< with equal weight
  float median_ratio = 1;  ///< median of the ratios of single movements
};

/// Returns whether the model is better by more than 1 % in the mean and not worse in the median.
bool wins(const ResidualModel& model) noexcept;

/// Returns whether two models are equal up to rounding differences between compilers.
bool nearly_same(const ResidualModel& a, const ResidualModel& b) noexcept;

/// Writes the stored form.
void encode(const ResidualModel& model, ByteWriter& out);
/// Throws Error{corrupt} on bytes that `encode` cannot have written.
ResidualModel decode_residual_model(ByteReader& in);

}  // namespace signweave
