#include "signweave/features/gloss_stats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/features/test_sign.h"
#include "signweave/features/transition_stats.h"

namespace signweave {
namespace {

using testing::ElementsAre;

/// A B A B, a rest, A B; each stroke starts 100 ms after the begin of its sign and ends 100 ms before its end.
std::vector<Sign> two_units() {
  std::vector<Sign> signs;
  Milliseconds at = 0ms;
  for (const char* gloss : {"A", "B", "A", "B"}) {
    signs.push_back(sign_of_three(gloss, at, at + 100ms, at + 300ms, at + 400ms));
    at += 400ms;
  }
  at += 2000ms;
  signs.push_back(sign_of_three("A ", at, at + 100ms, at + 300ms, at + 400ms));
  signs.push_back(sign_of_three("B", at + 450ms, at + 650ms, at + 950ms, at + 1000ms));
  return signs;
}

TEST(GlossStats, CountsTokensAndTheirDurations) {
  const std::vector<GlossStats> of = glosses_of(two_units());
  ASSERT_EQ(of.size(), 2u);
  EXPECT_EQ(of[0].gloss, "A");  // "A " is the same
  EXPECT_EQ(of[0].sign.count, 3u);
  EXPECT_DOUBLE_EQ(of[0].sign.mean, 400);
  EXPECT_DOUBLE_EQ(of[0].stroke.mean, 200);
  EXPECT_DOUBLE_EQ(of[1].sign.most, 550);
  EXPECT_DOUBLE_EQ(of[1].stroke.most, 300);
}

TEST(GlossStats, AnInferredSignHasNoStrokeStatistics) {
  const std::vector<Sign> signs = {
      {.gloss = "A", .span = {0ms, 500ms}, .phases = {{PhaseKind::stroke, {0ms, 500ms}, "", ""}}, .inferred = true}};
  const std::vector<GlossStats> of = glosses_of(signs);
  ASSERT_EQ(of.size(), 1u);
  EXPECT_EQ(of[0].sign.count, 1u);
  EXPECT_EQ(of[0].stroke.count, 0u);
}

TEST(GlossStats, NgramsEndAtARest) {
  const std::vector<std::vector<Sign>> recordings = {two_units()};
  const std::vector<NgramStats> two = ngrams_of(recordings, 2);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_THAT(two[0].glosses, ElementsAre("A", "B"));
  EXPECT_EQ(two[0].count, 3u);
  EXPECT_DOUBLE_EQ(two[0].interval.mean, (200 + 200 + 350) / 3.0);  // stroke's end to stroke's begin
  EXPECT_THAT(two[1].glosses, ElementsAre("B", "A"));
  EXPECT_EQ(two[1].count, 1u);
  const std::vector<NgramStats> three = ngrams_of(recordings, 3);
  ASSERT_EQ(three.size(), 2u);
  EXPECT_EQ(three[0].count, 1u);
  EXPECT_EQ(three[0].interval.count, 2u);
  EXPECT_TRUE(ngrams_of(recordings, 5).empty());
}

TEST(GlossStats, NgramsDoNotSpanTiersOrRecordings) {
  std::vector<Sign> signs = two_units();
  const std::vector<std::vector<Sign>> apart = {{signs[0]}, {signs[1]}};
  EXPECT_TRUE(ngrams_of(apart, 2).empty());
  signs.resize(2);
  signs[1].tier = "Gloss LH";
  const std::vector<std::vector<Sign>> tiers = {signs};
  EXPECT_TRUE(ngrams_of(tiers, 2).empty());
}

}  // namespace
}  // namespace signweave
