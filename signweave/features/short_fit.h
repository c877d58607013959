#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

namespace signweave {

/// The least squares cubic through a few equal steps, in polynomials that are orthonormal over them: what each term
/// says is independent of the others, and noise of each sample comes into each term as it is.
class ShortFit {
 public:
  static constexpr std::size_t kTerms = 4;
  static constexpr std::size_t kMost = 32;  ///< samples
  using Terms = std::array<Eigen::Vector3f, kTerms>;

  /// Of so many samples, kTerms to kMost. Made once for all; threads may ask at the same time.
  static const ShortFit& of(std::size_t samples) noexcept;

  std::size_t samples() const noexcept { return samples_; }
  /// The value of a polynomial at a sample.
  float at(std::size_t term, std::size_t sample) const noexcept { return values_[term][sample]; }
  /// What each polynomial is to be taken times. `path` has the samples.
  Terms terms_of(std::span<const Eigen::Vector3f> path) const noexcept;

 private:
  explicit ShortFit(std::size_t samples) noexcept;

  std::size_t samples_ = 0;
  std::array<std::array<float, kMost>, kTerms> values_{};
};

}  // namespace signweave
