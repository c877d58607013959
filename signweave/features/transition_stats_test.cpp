#include "signweave/features/transition_stats.h"

#include <gtest/gtest.h>

namespace signweave {
namespace {

Sign sign(std::string gloss, Milliseconds begin, Milliseconds stroke, Milliseconds after, Milliseconds end) {
  return {.gloss = std::move(gloss),
          .span = {begin, end},
          .phases = {{PhaseKind::preparation, {begin, stroke}, "P", "p"},
                     {PhaseKind::stroke, {stroke, after}, "S", "s"},
                     {PhaseKind::retraction, {after, end}, "R", "r"}},
          .tier = "Gloss"};
}

TEST(TransitionStats, ATransitionIsRetractionPlusGapPlusPreparation) {
  const std::vector<Sign> signs = {sign("A", 0ms, 100ms, 300ms, 400ms), sign("B", 450ms, 700ms, 900ms, 1'000ms)};
  const std::vector<Transition> found = transitions_in(signs);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].span, (TimeSpan{300ms, 700ms}));
  EXPECT_EQ(found[0].retraction, 100ms);
  EXPECT_EQ(found[0].preparation, 250ms);
}

TEST(TransitionStats, ARestIsNoTransition) {
  std::vector<Sign> signs = {sign("A", 0ms, 100ms, 300ms, 400ms), sign("B", 501ms, 600ms, 700ms, 800ms)};
  EXPECT_TRUE(transitions_in(signs).empty());
  signs[0].inferred = true;  // without phases the gap is all there is
  EXPECT_EQ(transitions_in(signs).size(), 1u);
  signs[1] = sign("B", 415ms, 500ms, 600ms, 700ms);  // glosses that touch tell nothing
  EXPECT_TRUE(transitions_in(signs).empty());
  signs[1] = sign("B", 1'401ms, 1'500ms, 1'600ms, 1'700ms);
  EXPECT_TRUE(transitions_in(signs).empty());
}

TEST(TransitionStats, TiersAreNotMixed) {
  std::vector<Sign> signs = {sign("A", 0ms, 100ms, 300ms, 400ms), sign("B", 450ms, 700ms, 900ms, 1'000ms)};
  signs[1].tier = "Gloss LH";
  EXPECT_TRUE(transitions_in(signs).empty());
}

TEST(TransitionStats, AnnotatedTransitionsOutweighInferredOnes) {
  const std::vector<Transition> mixed = {
      {.span = {0ms, 600ms}}, {.span = {0ms, 800ms}}, {.span = {0ms, 5ms}, .inferred = true}};
  const TransitionStats stats = summarize(mixed);
  EXPECT_EQ(stats.count, 2u);
  EXPECT_FALSE(stats.inferred);
  EXPECT_EQ(stats.mean, 700ms);
  EXPECT_EQ(stats.deviation, 100ms);
  EXPECT_EQ(stats.median, 700ms);
  EXPECT_EQ(stats.percentile_10, 620ms);
  EXPECT_EQ(stats.percentile_90, 780ms);
}

TEST(TransitionStats, NothingMeasuredCountsZero) {
  const TransitionStats stats = summarize({});
  EXPECT_EQ(stats.count, 0u);
  EXPECT_EQ(stats.mean, 0ms);
}

}  // namespace
}  // namespace signweave
