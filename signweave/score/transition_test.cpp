#include "signweave/score/transition.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

namespace signweave {
namespace {

RC_GTEST_PROP(TransitionCut, EveryMethodFillsTheWholeTransitionFromWhatThereIs, ()) {
  const TransitionRoom room{.length = *rc::gen::inRange<std::int64_t>(1, 400),
                            .retraction = *rc::gen::inRange<std::int64_t>(0, 300),
                            .preparation = *rc::gen::inRange<std::int64_t>(0, 300),
                            .frames_per_second = *rc::gen::element(24.0, 60.0, 120.0),
                            .pause = *rc::gen::arbitrary<bool>()};
  for (const TransitionMethod& method : transition_methods()) {
    const TransitionCut cut = method.cut != nullptr ? method.cut(room) : cut_with_gap(room);
    RC_ASSERT(cut.length == room.length);
    RC_ASSERT(cut.retraction_frames >= 0 && cut.retraction_frames <= room.retraction);
    RC_ASSERT(cut.preparation_frames >= 0 && cut.preparation_frames <= room.preparation);
    RC_ASSERT(cut.overlap() <= std::min(cut.retraction_frames, cut.preparation_frames));
    RC_ASSERT(cut.retraction_frames + cut.preparation_frames - cut.overlap() + cut.gap() == room.length);
    RC_ASSERT(cut.blend_frames >= 0);
    RC_ASSERT(3 * std::max(cut.overlap(), cut.gap()) >= room.length);  // the hands need not jump
  }
}

TEST(TransitionMethods, AreThePapersReadingsAndTheGapMethodsForSigning) {
  std::vector<std::string_view> names;
  for (const TransitionMethod& method : transition_methods()) {
    names.push_back(method.name);
    ASSERT_NE(method.fill, nullptr);
    EXPECT_EQ(method.fill->offered, Offered::signing) << method.name;
    EXPECT_EQ(method.cut != nullptr, method.name == "overlap" || method.name == "gap") << method.name;
  }
  EXPECT_THAT(names, testing::IsSupersetOf({"overlap", "gap", "sine"}));
  EXPECT_EQ(names.front(), gap_methods().front().name);
  EXPECT_EQ(std::set<std::string_view>(names.begin(), names.end()).size(), names.size());
  EXPECT_EQ(find_transition_method("hold"), nullptr);  // a baseline
}

TEST(TransitionCut, OverlapHasTheLengthOfThePaper) {
  const TransitionCut cut = find_transition_method("overlap")->cut({.length = 60, .retraction = 50, .preparation = 50});
  EXPECT_EQ(cut.blend_frames, 20);
  EXPECT_EQ(cut.retraction_frames + cut.preparation_frames - cut.blend_frames, 60);
  EXPECT_EQ(cut.gap(), 0);
}

TEST(TransitionCut, ASignWithoutRetractionLeavesAGap) {
  const TransitionCut cut = find_transition_method("overlap")->cut({.length = 60, .retraction = 0, .preparation = 40});
  EXPECT_EQ(cut.retraction_frames, 0);
  EXPECT_EQ(cut.preparation_frames, 40);
  EXPECT_EQ(cut.gap(), 20);
  EXPECT_EQ(cut.overlap(), 0);
}

TEST(TransitionCut, WithFewCapturedFramesTheMiddleIsGenerated) {
  const TransitionCut cut = find_transition_method("overlap")->cut({.length = 60, .retraction = 30, .preparation = 28});
  EXPECT_EQ(cut.overlap(), 0);
  EXPECT_EQ(cut.gap(), 20);
}

TEST(Crossfade, RisesFromAboveZeroToBelowOne) {
  float before = 0;
  for (std::int64_t i = 0; i < 30; ++i) {
    const float weight = crossfade_weight(i, 30);
    EXPECT_GT(weight, before);
    EXPECT_LT(weight, 1.0f);
    before = weight;
  }
  EXPECT_NEAR(crossfade_weight(0, 1), 0.5f, 1e-6f);
}

}  // namespace
}  // namespace signweave
