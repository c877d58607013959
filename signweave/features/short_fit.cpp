#include "signweave/features/short_fit.h"

#include <cassert>
#include <cmath>
#include <utility>

namespace signweave {

const ShortFit& ShortFit::of(std::size_t samples) noexcept {
  static const auto all = []<std::size_t... i>(std::index_sequence<i...>) {
    return std::array{ShortFit(kTerms + i)...};
  }
  (std::make_index_sequence<kMost - kTerms + 1>());
  assert(samples >= kTerms && samples <= kMost);
  return all[samples - kTerms];
}

ShortFit::ShortFit(std::size_t samples) noexcept : samples_(samples) {
  const double middle = 0.5 * static_cast<double>(samples - 1);
  std::array<std::array<double, kMost>, kTerms> made{};
  for (std::size_t term = 0; term < kTerms; ++term) {
    for (std::size_t k = 0; k < samples; ++k) made[term][k] = std::pow(static_cast<double>(k) - middle, term);
    for (std::size_t other = 0; other < term; ++other) {  // Gram and Schmidt
      double common = 0;
      for (std::size_t k = 0; k < samples; ++k) common += made[term][k] * made[other][k];
      for (std::size_t k = 0; k < samples; ++k) made[term][k] -= common * made[other][k];
    }
    double square = 0;
    for (std::size_t k = 0; k < samples; ++k) square += made[term][k] * made[term][k];
    for (std::size_t k = 0; k < samples; ++k) {
      made[term][k] /= std::sqrt(square);
      values_[term][k] = static_cast<float>(made[term][k]);
    }
  }
}

ShortFit::Terms ShortFit::terms_of(std::span<const Eigen::Vector3f> path) const noexcept {
  Terms terms;
  terms.fill(Eigen::Vector3f::Zero());
  for (std::size_t k = 0; k < samples_; ++k) {
    for (std::size_t term = 0; term < kTerms; ++term) terms[term] += values_[term][k] * path[k];
  }
  return terms;
}

}  // namespace signweave
