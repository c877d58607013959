#include "signweave/evaluation/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace signweave {
namespace {

constexpr double kNoEstimate = std::numeric_limits<double>::quiet_NaN();

struct Sums {
  double value = 0;
  double weight = 0;
};

double figure_of(const Sums& sums, Pooling pooling) {
  const double mean = sums.weight > 0 ? sums.value / sums.weight : kNoEstimate;
  return pooling == Pooling::geometric ? std::exp(mean) : mean;
}

/// Of ascending numbers, between two of them where it must be.
double percentile(const std::vector<double>& sorted, double share) {
  const double exact = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(exact);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (exact - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

const std::vector<std::uint32_t>& Bootstrap::draws_of(std::size_t clusters) {
  std::vector<std::uint32_t>& draws = draws_[clusters];
  if (!draws.empty()) return draws;
  std::mt19937_64 random(seed_);
  draws.resize(resamples_ * clusters);
  // The standard's distributions differ from library to library; the top bits times the count do not.
  for (std::uint32_t& draw : draws) draw = static_cast<std::uint32_t>(((random() >> 32) * clusters) >> 32);
  return draws;
}

Estimate Bootstrap::estimate(std::span<const ClusteredScore> scores, Pooling pooling) {
  std::map<std::size_t, Sums> by_cluster;
  Sums all;
  Estimate estimate{.value = kNoEstimate, .low = kNoEstimate, .high = kNoEstimate};
  for (const ClusteredScore& one : scores) {
    if (!one.score.known()) continue;
    Sums& sums = by_cluster[one.cluster];
    for (Sums* to : {&sums, &all}) {
      to->value += one.score.value;
      to->weight += one.score.weight;
    }
    ++estimate.scores;
  }
  estimate.clusters = by_cluster.size();
  estimate.value = figure_of(all, pooling);
  if (by_cluster.size() < 2) return estimate;
  std::vector<Sums> clusters;
  for (const auto& [cluster, sums] : by_cluster) clusters.push_back(sums);
  const std::vector<std::uint32_t>& draws = draws_of(clusters.size());
  std::vector<double> figures;
  figures.reserve(resamples_);
  for (std::size_t i = 0; i < resamples_; ++i) {
    Sums sums;
    for (std::size_t draw = i * clusters.size(); draw < (i + 1) * clusters.size(); ++draw) {
      sums.value += clusters[draws[draw]].value;
      sums.weight += clusters[draws[draw]].weight;
    }
    const double figure = figure_of(sums, pooling);
    if (std::isfinite(figure)) figures.push_back(figure);
  }
  if (figures.empty()) return estimate;
  std::sort(figures.begin(), figures.end());
  estimate.low = percentile(figures, (1 - kConfidence) / 2);
  estimate.high = percentile(figures, (1 + kConfidence) / 2);
  return estimate;
}

}  // namespace signweave
