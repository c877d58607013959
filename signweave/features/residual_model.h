#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "signweave/core/bytes.h"

namespace signweave {

/// What the wrists of a corpus do over a gap beyond the likeliest trajectory: a Gaussian process of a few vectors seen
/// at the borders, weighted by what of them does not change when everything is turned (gates). Whatever turns the
/// borders turns the result. (after the residuals of Δ-Interpolator, Oreshkin et al. 2022; the kernel is ours)
struct ResidualModel {
  /// Vectors, arm lengths: from border to border; velocities at both, times the duration; accelerations at both, times
  /// its square.
  static constexpr std::size_t kTraits = 5;
  /// Logarithms of the lengths of the first three, the cosines between them, the logarithm of the duration.
  static constexpr std::size_t kGates = 7;
  /// Functions of time that a residual is a sum of, see residual_bends.
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
  std::vector<Centre> centres;  ///< empty: it teaches nothing

  // How it did on movements of recordings (or signers) that it was not learned from.
  std::uint64_t movements = 0;   ///< that were looked at
  std::uint64_t recordings = 0;  ///< that they are from
  std::uint64_t folds = 0;       ///< that were left out in turn; 0: too little to compare
  bool by_signer = false;        ///< folds are signers, else recordings
  float mean_ratio = 1;          ///< of wrist errors to those of the likeliest trajectory: of their means, folds alike
  float median_ratio = 1;        ///< the median of single movements' ratios
};

/// Better in the mean by a hundredth, and not worse in the median.
bool wins(const ResidualModel& model) noexcept;

/// True where two say the same, give or take what another compiler rounds otherwise.
bool nearly_same(const ResidualModel& a, const ResidualModel& b) noexcept;

/// As it is stored.
void encode(const ResidualModel& model, ByteWriter& out);
/// Throws Error{corrupt} on bytes that `encode` cannot have written.
ResidualModel decode_residual_model(ByteReader& in);

}  // namespace signweave
