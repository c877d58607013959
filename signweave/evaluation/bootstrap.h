#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "signweave/evaluation/measure.h"

namespace signweave {

/// A score with its cluster, collection and part.
struct ClusteredScore {
  std::size_t cluster = 0;  ///< scores of one cluster are correlated: a recording
  Measurement score;
  std::size_t collection = 0;  ///< of clusters
  std::size_t part = 0;        ///< pooled separately first, such as a gap length; spans all clusters
};

/// A figure, its confidence interval and the size of its sample.
struct Estimate {
  double value = 0;  ///< NaN: nothing was measured
  double low = 0;    ///< of an interval of kConfidence; NaN with fewer than two clusters
  double high = 0;
  std::size_t scores = 0;
  std::size_t clusters = 0;
  std::size_t collections = 0;
};

/// A figure is pooled within each part of each collection; then parts have equal weight in a collection, and
/// collections in the figure, regardless of their number of scores. Intervals are percentiles of figures from resampled
/// clusters: within each collection, as many whole clusters as there are are drawn with replacement (Efron and
/// Tibshirani 1993, An Introduction to the Bootstrap; for clusters Davison and Hinkley 1997). The same seed gives the
/// same intervals.
class Bootstrap {
 public:
  explicit Bootstrap(std::uint64_t seed, std::size_t resamples = 1000) : seed_(seed), resamples_(resamples) {}

  /// Unknown scores are ignored.
  Estimate estimate(std::span<const ClusteredScore> scores, Pooling pooling);

 private:
  const std::vector<std::uint32_t>& draws_of(std::size_t collection, std::size_t clusters);

  std::uint64_t seed_;
  std::size_t resamples_;
  /// [index of the collection, clusters][resample][draw]
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::uint32_t>> draws_;
};
inline constexpr double kConfidence = 0.95;

}  // namespace signweave
