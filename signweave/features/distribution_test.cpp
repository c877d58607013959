#include "signweave/features/distribution.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numeric>

namespace signweave {
namespace {

TEST(Distribution, OfFourValues) {
  const std::vector<double> values = {10, 40, 20, 30};
  const Distribution of = distribution_of(values);
  EXPECT_EQ(of.count, 4u);
  EXPECT_DOUBLE_EQ(of.mean, 25);
  EXPECT_DOUBLE_EQ(of.deviation, std::sqrt(125.0));
  EXPECT_DOUBLE_EQ(of.least, 10);
  EXPECT_DOUBLE_EQ(of.most, 40);
  EXPECT_DOUBLE_EQ(of.median(), 25);
  EXPECT_DOUBLE_EQ(of.quantiles[0], 11.5);
  EXPECT_DOUBLE_EQ(of.quantiles[6], 38.5);
  // Student's t for 3 degrees of freedom times s / √n, s with n − 1: 3.182 · 12.910 / 2.
  EXPECT_NEAR(of.mean_high - of.mean, 20.54, 0.01);
  EXPECT_NEAR(of.mean - of.mean_low, 20.54, 0.01);
}

TEST(Distribution, OfNoValuesAndOfOne) {
  EXPECT_EQ(distribution_of({}).count, 0u);
  EXPECT_TRUE(distribution_of({}).histogram.counts.empty());
  const std::vector<double> one = {7};
  const Distribution of = distribution_of(one);
  EXPECT_EQ(of.mean_low, 7);
  EXPECT_EQ(of.mean_high, 7);
  EXPECT_EQ(of.deviation, 0);
  EXPECT_EQ(of.histogram.counts, std::vector<std::size_t>{1});
}

TEST(Distribution, StudentsTMatchesTables) {
  EXPECT_NEAR(student_t_95(1), 12.706, 0.001);
  EXPECT_NEAR(student_t_95(10), 2.228, 0.001);
  EXPECT_NEAR(student_t_95(11), 2.201, 0.001);
  EXPECT_NEAR(student_t_95(20), 2.086, 0.001);
  EXPECT_NEAR(student_t_95(30), 2.042, 0.001);
  EXPECT_NEAR(student_t_95(120), 1.980, 0.001);
  EXPECT_NEAR(student_t_95(1'000'000), 1.960, 0.001);
}

TEST(Distribution, AHistogramHasRoundBinsByFreedmanAndDiaconis) {
  std::vector<double> values(1000);
  std::iota(values.begin(), values.end(), 3.0);
  const Histogram of = distribution_of(values).histogram;
  EXPECT_EQ(of.width, 100);  // 2 · 499.5 / 10
  EXPECT_EQ(of.begin, 0);
  EXPECT_EQ(of.counts, (std::vector<std::size_t>{97, 100, 100, 100, 100, 100, 100, 100, 100, 100, 3}));
}

TEST(Distribution, BinWidthsAreTheNearestRoundOnes) {
  // Quartiles 870 and 1250 of 21 numbers: 2 · 380 / ∛21 = 275.
  std::vector<double> values = {610,  650,  670,  670,  720,  870,  980,  1010, 1030, 1050, 1060,
                                1110, 1150, 1170, 1240, 1250, 1250, 1270, 1290, 1500, 1760};
  EXPECT_EQ(distribution_of(values).histogram.width, 200);
}

RC_GTEST_PROP(Distribution, EveryValueIsInOneBin, (const std::vector<std::int32_t>& numbers)) {
  const std::vector<double> values(numbers.begin(), numbers.end());
  const Distribution of = distribution_of(values);
  RC_ASSERT(std::accumulate(of.histogram.counts.begin(), of.histogram.counts.end(), std::size_t{0}) == values.size());
  RC_ASSERT(of.histogram.counts.size() <= 41u);
  if (values.empty()) return;
  RC_ASSERT(of.histogram.begin <= of.least);
  RC_ASSERT(of.histogram.counts.front() > 0u);
  RC_ASSERT(of.histogram.counts.back() > 0u);
  RC_ASSERT(std::is_sorted(of.quantiles.begin(), of.quantiles.end()));
  RC_ASSERT(of.mean_low <= of.mean && of.mean <= of.mean_high);
}

}  // namespace
}  // namespace signweave
