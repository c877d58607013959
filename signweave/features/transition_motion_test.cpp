// The motion of the hands from one sign to the next.

#include <gtest/gtest.h>

#include "signweave/features/transition_stats.h"

namespace signweave {
namespace {

constexpr float kWidth = 0.4f;  // metres

/// A phase in which the right hand moves straight from x to x, shoulder widths, with the given path length in metres.
PhaseFeatures going(float from, float to, float path) {
  PhaseFeatures phase;
  phase.known = true;
  phase.hands[1].known = true;
  phase.hands[1].begin.position.x() = from;
  phase.hands[1].end.position.x() = to;
  phase.hands[1].path_length = path;
  return phase;
}

Sign sign_of(const std::vector<PhaseKind>& kinds) {
  Sign sign;
  for (const PhaseKind kind : kinds) sign.phases.push_back({.kind = kind, .span = {}, .label = {}, .annotation = {}});
  return sign;
}

const Sign kFrom = sign_of({PhaseKind::preparation, PhaseKind::stroke, PhaseKind::retraction});
const Sign kTo = sign_of({PhaseKind::preparation, PhaseKind::stroke});
const std::vector<PhaseFeatures> kFromPhases = {going(9, 9, 9), going(0, 1, 9), going(1.5f, 2, 0.3f)};
const std::vector<PhaseFeatures> kToPhases = {going(2.5f, 3, 0.5f), going(4, 9, 9)};

TEST(MotionBetween, FollowsTheRetractionAndThePreparation) {
  const auto motion = motion_between(kFrom, kFromPhases, kTo, kToPhases, kWidth);
  ASSERT_TRUE(motion.has_value());
  const HandTravel& retraction = motion->retraction[1];
  EXPECT_TRUE(retraction.known);
  EXPECT_NEAR(retraction.displacement, (2 - 1) * 0.4, 1e-6);
  EXPECT_NEAR(retraction.path, 0.5 * 0.4 + 0.3, 1e-6) << "straight to its begin, then along it";
  const HandTravel& preparation = motion->preparation[1];
  EXPECT_NEAR(preparation.displacement, (4 - 2.5) * 0.4, 1e-6);
  EXPECT_NEAR(preparation.path, 0.5 + 1 * 0.4, 1e-6);
  const HandTravel& whole = motion->whole[1];
  EXPECT_NEAR(whole.displacement, (4 - 1) * 0.4, 1e-6);
  EXPECT_NEAR(whole.path, retraction.path + preparation.path + 0.5 * 0.4, 1e-6);
  EXPECT_FALSE(motion->whole[0].known) << "the left hand was not measured";
}

TEST(MotionBetween, AdjacentStrokesHaveTheStepBetweenThem) {
  const Sign stroke = sign_of({PhaseKind::stroke});
  const std::vector<PhaseFeatures> first = {going(0, 1, 9)};
  const std::vector<PhaseFeatures> second = {going(1.5f, 2, 9)};
  const auto motion = motion_between(stroke, first, stroke, second, kWidth);
  ASSERT_TRUE(motion.has_value());
  EXPECT_NEAR(motion->whole[1].displacement, 0.2, 1e-6);
  EXPECT_NEAR(motion->whole[1].path, 0.2, 1e-6);
  EXPECT_NEAR(motion->retraction[1].path, 0, 1e-6);
}

TEST(MotionBetween, IsNulloptIfNothingWasMeasuredOrAnnotated) {
  const std::vector<PhaseFeatures> nothing(2);
  EXPECT_FALSE(motion_between(kFrom, kFromPhases, kTo, nothing, kWidth).has_value());
  EXPECT_FALSE(motion_between(kFrom, kFromPhases, kTo, {}, kWidth).has_value());
  Sign inferred = kFrom;
  inferred.inferred = true;
  EXPECT_FALSE(motion_between(inferred, kFromPhases, kTo, kToPhases, kWidth).has_value());
  EXPECT_FALSE(motion_between(sign_of({PhaseKind::hold}), {kFromPhases.data(), 1}, kTo, kToPhases, kWidth).has_value());
}

}  // namespace
}  // namespace signweave
