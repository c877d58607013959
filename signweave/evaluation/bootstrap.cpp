#include "signweave/evaluation/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace signweave {
namespace {

constexpr double kNoEstimate = std::numeric_limits<double>::quiet_NaN();

struct Sums {
  double value = 0;
  double weight = 0;
};

/// The scores of one collection.
struct Collection {
  std::vector<std::vector<Sums>> clusters;  ///< [cluster][part]

  /// Pooled over the drawn clusters and then over parts; NaN if nothing was measured.
  double figure(std::span<const std::uint32_t> drawn, std::vector<Sums>& scratch) const {
    scratch.assign(clusters.front().size(), Sums{});
    for (const std::size_t cluster : drawn) {
      for (std::size_t part = 0; part < scratch.size(); ++part) {
        scratch[part].value += clusters[cluster][part].value;
        scratch[part].weight += clusters[cluster][part].weight;
      }
    }
    double sum = 0;
    double parts = 0;
    for (const Sums& sums : scratch) {
      if (!(sums.weight > 0)) continue;
      sum += sums.value / sums.weight;
      parts += 1;
    }
    return parts > 0 ? sum / parts : kNoEstimate;
  }
};

/// The percentile of ascending numbers, interpolated.
double percentile(const std::vector<double>& sorted, double share) {
  const double exact = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(exact);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (exact - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

const std::vector<std::uint32_t>& Bootstrap::draws_of(std::size_t collection, std::size_t clusters) {
  std::vector<std::uint32_t>& draws = draws_[{collection, clusters}];
  if (!draws.empty()) return draws;
  std::mt19937_64 random(seed_ + collection * 0x9E3779B97F4A7C15u);
  draws.resize(resamples_ * clusters);
  // Standard distributions differ between libraries; the top bits times the count do not.
  for (std::uint32_t& draw : draws) draw = static_cast<std::uint32_t>(((random() >> 32) * clusters) >> 32);
  return draws;
}

Estimate Bootstrap::estimate(std::span<const ClusteredScore> scores, Pooling pooling) {
  Estimate estimate{.value = kNoEstimate, .low = kNoEstimate, .high = kNoEstimate};
  std::map<std::size_t, std::map<std::size_t, std::size_t>> places;  // [collection][cluster]
  std::map<std::size_t, std::size_t> parts;
  for (const ClusteredScore& one : scores) {
    if (!one.score.known()) continue;
    places[one.collection].try_emplace(one.cluster, places[one.collection].size());
    parts.try_emplace(one.part, parts.size());
    ++estimate.scores;
  }
  std::vector<Collection> collections;
  std::map<std::size_t, std::size_t> place_of_collection;
  bool resampled = false;
  for (const auto& [collection, clusters] : places) {
    place_of_collection[collection] = collections.size();
    collections.push_back({.clusters = {clusters.size(), std::vector<Sums>(parts.size())}});
    estimate.clusters += clusters.size();
    resampled = resampled || clusters.size() > 1;
  }
  estimate.collections = collections.size();
  for (const ClusteredScore& one : scores) {
    if (!one.score.known()) continue;
    Sums& sums =
        collections[place_of_collection[one.collection]].clusters[places[one.collection][one.cluster]][parts[one.part]];
    sums.value += one.score.value;
    sums.weight += one.score.weight;
  }
  std::vector<Sums> scratch;
  const auto pooled = [&](auto drawn_of) {
    double sum = 0;
    for (std::size_t i = 0; i < collections.size(); ++i) sum += collections[i].figure(drawn_of(i), scratch);
    const double mean = collections.empty() ? kNoEstimate : sum / static_cast<double>(collections.size());
    return pooling == Pooling::geometric ? std::exp(mean) : mean;
  };
  std::vector<std::uint32_t> each(estimate.clusters);  // once
  std::iota(each.begin(), each.end(), 0u);
  estimate.value =
      pooled([&](std::size_t i) { return std::span<const std::uint32_t>(each).first(collections[i].clusters.size()); });
  if (!resampled) return estimate;
  std::vector<double> figures;
  figures.reserve(resamples_);
  for (std::size_t resample = 0; resample < resamples_; ++resample) {
    const double figure = pooled([&](std::size_t i) {
      const std::size_t count = collections[i].clusters.size();
      return std::span<const std::uint32_t>(draws_of(i, count)).subspan(resample * count, count);
    });
    if (std::isfinite(figure)) figures.push_back(figure);
  }
  if (figures.empty()) return estimate;
  std::sort(figures.begin(), figures.end());
  estimate.low = percentile(figures, (1 - kConfidence) / 2);
  estimate.high = percentile(figures, (1 + kConfidence) / 2);
  return estimate;
}

}  // namespace signweave
