#include "signweave/synthesis/transition.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "signweave/synthesis/test_motion.h"

namespace signweave {
namespace {

using testing_motion::angle;
using testing_motion::moving;

RC_GTEST_PROP(TransitionCut, EveryMethodFillsTheWholeTransitionFromWhatThereIs, ()) {
  const TransitionRoom room{.length = *rc::gen::inRange<std::int64_t>(1, 400),
                            .retraction = *rc::gen::inRange<std::int64_t>(0, 300),
                            .preparation = *rc::gen::inRange<std::int64_t>(0, 300),
                            .frames_per_second = *rc::gen::element(24.0, 60.0, 120.0),
                            .pause = *rc::gen::arbitrary<bool>()};
  for (const TransitionMethod& method : transition_methods()) {
    const TransitionCut cut = method.cut(room);
    RC_ASSERT(cut.length == room.length);
    RC_ASSERT(cut.retraction_frames >= 0 && cut.retraction_frames <= room.retraction);
    RC_ASSERT(cut.preparation_frames >= 0 && cut.preparation_frames <= room.preparation);
    RC_ASSERT(cut.overlap() <= std::min(cut.retraction_frames, cut.preparation_frames));
    RC_ASSERT(cut.retraction_frames + cut.preparation_frames - cut.overlap() + cut.gap() == room.length);
    RC_ASSERT(cut.blend_frames >= 0);
    RC_ASSERT(3 * std::max(cut.overlap(), cut.gap()) >= room.length);  // the hands need not leap
  }
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

TEST(TransitionCut, WhereTheCapturedFramesHardlyMeetTheMiddleIsMade) {
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

/// The poses of a motion, then a made gap, then the poses of another: as a synthesis would have them.
Motion with_gap(const Motion& a, const Motion& b, std::int64_t gap, std::int64_t context) {
  Motion all(a.shared_skeleton(), a.rate());
  for (std::int64_t i = 0; i < a.frame_count(); ++i) all.append(a.pose(i));
  const std::int64_t last = a.frame_count() - 1;
  const Border from{a.pose(last), a.pose(last - context), context};
  const Border to{b.pose(0), b.pose(context), context};
  GapFiller filler;
  filler.between(from, to, gap, 15);
  for (std::int64_t i = 0; i < gap; ++i) filler.fill(i, all.append());
  for (std::int64_t i = 0; i < b.frame_count(); ++i) all.append(b.pose(i));
  return all;
}

TEST(Gap, ContinuesPositionAndVelocityAtBothBorders) {
  const Motion a = moving(40, {100, 1}, 0.3f);
  const Motion b = moving(40, {100, 1}, 0.7f);
  for (const std::int64_t gap : {3, 24, 150}) {
    const Motion all = with_gap(a, b, gap, 2);
    for (std::size_t joint = 0; joint < all.skeleton().joint_count(); ++joint) {
      const auto speed = [&](std::int64_t frame) {
        return angle(all.pose(frame).rotations[joint], all.pose(frame + 1).rotations[joint]);
      };
      for (const std::int64_t border : {std::int64_t{39}, std::int64_t{39 + gap}}) {
        // Across the border the speed changes no more than the first frame's share of the cross-fade explains.
        EXPECT_NEAR(speed(border - 1), speed(border), 0.001 + 8.0 / std::pow(static_cast<double>(gap + 1), 2))
            << "joint " << joint << " at " << border;
      }
    }
  }
}

TEST(Gap, StaysBetweenStillBorders) {
  Motion a = moving(3, {100, 1}, 0.3f);
  Motion b = moving(3, {100, 1}, 0.9f);
  const Border from{a.pose(0), a.pose(0), 0};
  const Border to{b.pose(0), b.pose(0), 0};
  Pose made(a.skeleton());
  GapFiller gap;
  gap.between(from, to, 50, 15);
  for (std::int64_t i = 0; i < 50; ++i) {
    gap.fill(i, made.view());
    for (std::size_t joint = 0; joint < made.rotations.size(); ++joint) {
      const double whole = angle(a.pose(0).rotations[joint], b.pose(0).rotations[joint]);
      EXPECT_NEAR(angle(a.pose(0).rotations[joint], made.rotations[joint]) +
                      angle(made.rotations[joint], b.pose(0).rotations[joint]),
                  whole, 1e-3);
      EXPECT_NEAR(made.rotations[joint].norm(), 1.0f, 1e-5f);
    }
  }
}

TEST(TransitionDuration, IsTheCorpusMeanUnlessGiven) {
  EXPECT_EQ(transition_duration({}, {.count = 3, .mean = 735ms}), 735ms);
  EXPECT_EQ(transition_duration({.fixed = 200ms}, {.count = 3, .mean = 735ms}), 200ms);
  EXPECT_EQ(transition_duration({}, {}), kUnmeasuredTransition);
}

}  // namespace
}  // namespace signweave
