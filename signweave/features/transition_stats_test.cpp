#include "signweave/features/transition_stats.h"

#include <gtest/gtest.h>

#include "signweave/features/test_sign.h"

namespace signweave {
namespace {

TEST(TransitionStats, ATransitionIsRetractionPlusGapPlusPreparation) {
  const std::vector<Sign> signs = {sign_of_three("A", 0ms, 100ms, 300ms, 400ms),
                                   sign_of_three("B", 450ms, 700ms, 900ms, 1'000ms)};
  const std::vector<AnnotatedTransition> found = transitions_in(signs);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].span, (TimeSpan{300ms, 700ms}));
  EXPECT_EQ(found[0].retraction, 100ms);
  EXPECT_EQ(found[0].preparation, 250ms);
}

TEST(TransitionStats, ARestIsNotATransition) {
  std::vector<Sign> signs = {sign_of_three("A", 0ms, 100ms, 300ms, 400ms),
                             sign_of_three("B", 501ms, 600ms, 700ms, 800ms)};
  EXPECT_TRUE(transitions_in(signs).empty());
  signs[0].inferred = true;  // without phases only the gap is known
  EXPECT_EQ(transitions_in(signs).size(), 1u);
  signs[1] = sign_of_three("B", 415ms, 500ms, 600ms, 700ms);  // adjacent glosses give no information
  EXPECT_TRUE(transitions_in(signs).empty());
  signs[1] = sign_of_three("B", 1'401ms, 1'500ms, 1'600ms, 1'700ms);
  EXPECT_TRUE(transitions_in(signs).empty());
}

TEST(TransitionStats, TiersAreNotMixed) {
  std::vector<Sign> signs = {sign_of_three("A", 0ms, 100ms, 300ms, 400ms),
                             sign_of_three("B", 450ms, 700ms, 900ms, 1'000ms)};
  signs[1].tier = "Gloss LH";
  EXPECT_TRUE(transitions_in(signs).empty());
}

TEST(TransitionStats, AnnotatedTransitionsTakePrecedenceOverInferredOnes) {
  const std::vector<AnnotatedTransition> mixed = {
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

RecordedTransition recorded(std::string from, std::string to, Milliseconds whole, bool inferred = false) {
  return {.recording = "r",
          .from = std::move(from),
          .to = std::move(to),
          .transition = {.span = {1'000ms, 1'000ms + whole},
                         .retraction = whole / 4,
                         .preparation = 3 * whole / 4,
                         .inferred = inferred}};
}

TEST(TransitionStats, PartsAddUpToTheWhole) {
  const std::vector<RecordedTransition> all = {recorded("A", "B", 400ms), recorded("B", "A", 800ms),
                                               recorded("A", "B", 30ms, true)};
  const TransitionSummary of = describe(all);
  EXPECT_FALSE(of.inferred);
  EXPECT_EQ(of.whole.duration.count, 2u);
  EXPECT_DOUBLE_EQ(of.whole.duration.mean, 600);
  EXPECT_DOUBLE_EQ(of.retraction.duration.mean, 150);
  EXPECT_DOUBLE_EQ(of.preparation.duration.mean, 450);
  EXPECT_EQ(counted_transitions(all).size(), 2u);
}

TEST(TransitionStats, InferredTransitionsHaveNoParts) {
  const std::vector<RecordedTransition> all = {recorded("A", "B", 400ms, true)};
  const TransitionSummary of = describe(all);
  EXPECT_TRUE(of.inferred);
  EXPECT_EQ(of.whole.duration.count, 1u);
  EXPECT_EQ(of.retraction.duration.count, 0u);
}

TEST(TransitionStats, PairsAreSortedByFrequency) {
  const std::vector<RecordedTransition> all = {recorded("C", "D", 100ms), recorded("A", "B", 400ms),
                                               recorded(" A", "B", 800ms), recorded("B", "A", 900ms)};
  const std::vector<PairStats> pairs = by_pair(all);
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_EQ(pairs[0].from, "A");
  EXPECT_EQ(pairs[0].to, "B");
  EXPECT_EQ(pairs[0].summary.whole.duration.count, 2u);
  EXPECT_DOUBLE_EQ(pairs[0].summary.whole.duration.mean, 600);
  EXPECT_EQ(pairs[1].from, "B");
  EXPECT_EQ(pairs[2].from, "C");
}

TEST(TransitionStats, RecordedTransitionsNameTheirSigns) {
  const std::vector<Sign> signs = {sign_of_three("A", 0ms, 100ms, 300ms, 400ms),
                                   sign_of_three("B", 450ms, 700ms, 900ms, 1'000ms)};
  const auto motion_of = [](const Sign& from, const Sign& to,
                            const AnnotatedTransition&) -> std::optional<TransitionMotion> {
    TransitionMotion motion;
    motion.whole[0] = {.known = true, .displacement = from.gloss == "A" ? 0.25 : 0, .path = to.gloss == "B" ? 0.5 : 0};
    return motion;
  };
  const std::vector<RecordedTransition> found = recorded_transitions("meteo", signs, motion_of);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].recording, "meteo");
  EXPECT_EQ(found[0].from, "A");
  EXPECT_EQ(found[0].to, "B");
  const TransitionSummary of = describe(found);
  EXPECT_DOUBLE_EQ(of.whole.hands[0].displacement.mean, 0.25);
  EXPECT_DOUBLE_EQ(of.whole.hands[0].path.mean, 0.5);
  EXPECT_DOUBLE_EQ(of.whole.hands[0].speed.mean, 1.25);  // 0.5 m in 400 ms
  EXPECT_EQ(of.whole.hands[1].path.count, 0u);           // not measured
  EXPECT_EQ(of.retraction.hands[0].path.count, 0u);
}

TEST(TransitionStats, APartWithoutDurationHasNoSpeed) {
  RecordedTransition one = recorded("A", "B", 0ms);
  one.motion.emplace();
  one.motion->whole[1] = {.known = true, .displacement = 0.1, .path = 0.1};
  const std::vector<RecordedTransition> all = {one};
  const TransitionSummary of = describe(all);
  EXPECT_EQ(of.whole.hands[1].path.count, 1u);
  EXPECT_EQ(of.whole.hands[1].speed.count, 0u);
}

TEST(TransitionStats, NothingMeasuredCountsZero) {
  const TransitionStats stats = summarize({});
  EXPECT_EQ(stats.count, 0u);
  EXPECT_EQ(stats.mean, 0ms);
}

}  // namespace
}  // namespace signweave
