#include "signweave/evaluation/bootstrap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace signweave {
namespace {

TEST(Bootstrap, PoolsMeansGeometricMeansAndRatios) {
  Bootstrap bootstrap(1);
  const std::vector<ClusteredScore> scores = {{0, {1, 2}}, {1, {3, 4}}, {1, {5, 10}}};
  EXPECT_DOUBLE_EQ(bootstrap.estimate(scores, Pooling::ratio).value, 9.0 / 16.0);
  const std::vector<ClusteredScore> plain = {{0, {1}}, {1, {3}}, {1, {5}}};
  EXPECT_DOUBLE_EQ(bootstrap.estimate(plain, Pooling::mean).value, 3.0);
  EXPECT_DOUBLE_EQ(bootstrap.estimate(plain, Pooling::geometric).value, std::exp(3.0));
}

TEST(Bootstrap, UnknownScoresAreIgnored) {
  Bootstrap bootstrap(1);
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Estimate estimate =
      bootstrap.estimate(std::vector<ClusteredScore>{{0, {2}}, {1, {4}}, {2, {none}}, {3, {1, none}}}, Pooling::mean);
  EXPECT_DOUBLE_EQ(estimate.value, 3);
  EXPECT_EQ(estimate.scores, 2u);
  EXPECT_EQ(estimate.clusters, 2u);
  EXPECT_TRUE(std::isnan(bootstrap.estimate({}, Pooling::mean).value));
}

TEST(Bootstrap, OneClusterGivesNoInterval) {
  Bootstrap bootstrap(1);
  const Estimate estimate = bootstrap.estimate(std::vector<ClusteredScore>{{7, {2}}, {7, {4}}}, Pooling::mean);
  EXPECT_DOUBLE_EQ(estimate.value, 3);
  EXPECT_TRUE(std::isnan(estimate.low));
  EXPECT_TRUE(std::isnan(estimate.high));
}

TEST(Bootstrap, TheSameSeedGivesTheSameBits) {
  std::vector<ClusteredScore> scores;
  for (std::size_t i = 0; i < 60; ++i) scores.push_back({i % 12, {std::sin(static_cast<double>(i))}});
  const auto interval = [&](std::uint64_t seed) {
    const Estimate estimate = Bootstrap(seed).estimate(scores, Pooling::mean);
    return std::pair(estimate.low, estimate.high);
  };
  EXPECT_EQ(interval(5), interval(5));
  EXPECT_NE(interval(5), interval(6));
}

TEST(Bootstrap, IntervalsCoverTheTruthDespiteCorrelatedScores) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  constexpr int kTrials = 300;
  int held = 0;
  int held_by_scores = 0;  // for comparison: an interval that treats scores as independent
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<ClusteredScore> scores;
    std::vector<ClusteredScore> alone;
    for (std::size_t cluster = 0; cluster < 30; ++cluster) {
      const double shared = normal(random);
      for (int i = 0; i < 8; ++i) {
        scores.push_back({cluster, {10 + shared + 0.5 * normal(random)}});
        alone.push_back({alone.size(), scores.back().score});
      }
    }
    const auto holds = [&](const std::vector<ClusteredScore>& of) {
      const Estimate estimate = Bootstrap(static_cast<std::uint64_t>(trial), 400).estimate(of, Pooling::mean);
      return estimate.low <= 10 && 10 <= estimate.high ? 1 : 0;
    };
    held += holds(scores);
    if (trial < 100) held_by_scores += holds(alone);
  }
  EXPECT_GT(held, kTrials * 88 / 100);
  EXPECT_LT(held, kTrials * 99 / 100);
  EXPECT_LT(held_by_scores, 75);
}

TEST(Bootstrap, CollectionsAndTheirPartsHaveEqualWeight) {
  Bootstrap bootstrap(1);
  // A collection of many scores of 1, and one with a single 3.
  std::vector<ClusteredScore> scores;
  for (std::size_t i = 0; i < 50; ++i) scores.push_back({.cluster = i, .score = {1}, .collection = 0});
  scores.push_back({.cluster = 50, .score = {3}, .collection = 1});
  Estimate estimate = bootstrap.estimate(scores, Pooling::mean);
  EXPECT_DOUBLE_EQ(estimate.value, 2);
  EXPECT_EQ(estimate.clusters, 51u);
  EXPECT_EQ(estimate.collections, 2u);
  EXPECT_DOUBLE_EQ(estimate.low, 2) << "resampled within collections, which have no variance here";
  // Ratios of two parts, 1/2 and 4/2, independent of their sizes.
  const std::vector<ClusteredScore> parts = {{.cluster = 0, .score = {1, 2}, .part = 0},
                                             {.cluster = 0, .score = {4, 2}, .part = 1},
                                             {.cluster = 1, .score = {40, 20}, .part = 1}};
  EXPECT_DOUBLE_EQ(bootstrap.estimate(parts, Pooling::ratio).value, 1.25);
}

}  // namespace
}  // namespace signweave
