#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

namespace signweave {

/// Least-squares cubic through a few equidistant samples, in polynomials that are orthonormal over them: the
/// coefficients are independent of each other, and the noise of the samples enters each coefficient unscaled.
class ShortFit {
 public:
  static constexpr std::size_t kTerms = 4;
  static constexpr std::size_t kMost = 32;  ///< samples
  using Terms = std::array<Eigen::Vector3f, kTerms>;

  /// Returns the fit for this number of samples, kTerms to kMost. Built once; thread-safe.
  static const ShortFit& of(std::size_t samples) noexcept;

  std::size_t samples() const noexcept { return samples_; }
  /// The value of a polynomial at a sample.
  float at(std::size_t term, std::size_t sample) const noexcept { return values_[term][sample]; }
  /// Returns the coefficient of each polynomial. `path` must contain samples() points.
  Terms terms_of(std::span<const Eigen::Vector3f> path) const noexcept;

 private:
  explicit ShortFit(std::size_t samples) noexcept;

  std::size_t samples_ = 0;
  std::array<std::array<float, kMost>, kTerms> values_{};
};

}  // namespace signweave
