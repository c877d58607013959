#include "signweave/nonmanual/blinks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "signweave/core/error.h"

namespace signweave {
namespace {

/// Half an hour of signing: boundaries every 2.2 s, strokes of 600 ms every 900 ms.
struct Signing {
  TimeSpan whole{0ms, 1'800'000ms};
  std::vector<Milliseconds> boundaries;
  std::vector<TimeSpan> strokes;
  Signing() {
    for (Milliseconds at = 2'200ms; at < whole.end; at += 2'200ms) boundaries.push_back(at);
    for (Milliseconds at = 300ms; at < whole.end; at += 900ms) strokes.push_back({at, at + 600ms});
  }
  std::vector<Milliseconds> plan(std::uint64_t seed = 0) const {
    return plan_blinks(whole, boundaries, strokes, {.seed = seed});
  }
};

TEST(Blinks, HaveTheirRateAndMostAreAtBoundaries) {
  const Signing signing;
  double all = 0;
  double at_boundaries = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    for (const Milliseconds at : signing.plan(seed)) {
      ++all;
      at_boundaries += std::ranges::find(signing.boundaries, at) != signing.boundaries.end() ? 1 : 0;
    }
  }
  EXPECT_NEAR(all / 240, 12.5, 0.6);  // a minute
  EXPECT_NEAR(at_boundaries / all, 0.7, 0.05);
}

TEST(Blinks, KeepTheirDistance) {
  const std::vector<Milliseconds> plan = Signing().plan();
  for (std::size_t i = 1; i < plan.size(); ++i) EXPECT_GE(plan[i] - plan[i - 1], 400ms);
}

TEST(Blinks, NoneBeginsAStrokeIfItCanBeElsewhere) {
  const Signing signing;
  for (const Milliseconds at : signing.plan()) {
    if (std::ranges::find(signing.boundaries, at) != signing.boundaries.end()) continue;
    for (const TimeSpan& stroke : signing.strokes) {
      EXPECT_FALSE(at >= stroke.begin && at < stroke.begin + 200ms) << at.count();
    }
  }
}

TEST(Blinks, DependOnTheSeedAlone) {
  const Signing signing;
  EXPECT_EQ(signing.plan(5), signing.plan(5));
  EXPECT_NE(signing.plan(5), signing.plan(6));
}

RC_GTEST_PROP(Blinks, AStreamPlansWhatAFilePlans, ()) {
  const Signing whole;
  const Milliseconds known(*rc::gen::inRange(0, 60'000));
  Signing part;
  part.whole.end = known;
  std::erase_if(part.boundaries, [&](Milliseconds at) { return at >= known; });
  std::erase_if(part.strokes, [&](const TimeSpan& stroke) { return stroke.begin >= known; });
  const auto until = [&](std::vector<Milliseconds> plan) {
    std::erase_if(plan, [&](Milliseconds at) { return at >= known - kBlinkHorizon; });
    return plan;
  };
  RC_ASSERT(until(part.plan(3)) == until(whole.plan(3)));
}

TEST(Blinks, RefuseAnImpossibleRate) {
  EXPECT_THROW(plan_blinks({0ms, 1s}, {}, {}, {.per_minute = 1e9}), Error);
  EXPECT_THROW(plan_blinks({0ms, 1s}, {}, {}, {.at_boundaries = -1}), Error);
  EXPECT_THROW(plan_blinks({0ms, 1s}, {}, {}, {.spacing = -1ms}), Error);
  EXPECT_TRUE(plan_blinks({0ms, 600s}, {}, {}, {.per_minute = 0}).empty());
}

TEST(Blinks, ShutTheLidsAtAWholeFrame) {
  for (const FrameRate rate : {FrameRate{12, 1}, FrameRate{25, 1}, FrameRate{30'000, 1001}, FrameRate{120, 1}}) {
    std::vector<float> left(200, 0.0f);
    const TrackSpan span{"eyeBlinkLeft", left};
    apply(blink_at(777ms).curve, blink_frames(777ms, rate), rate, {0, 200}, {&span, 1});
    const auto shut = std::ranges::find(left, 1.0f) - left.begin();
    EXPECT_EQ(shut, std::llround(0.777 * rate.hertz())) << to_string(rate);
    EXPECT_EQ(std::ranges::count(left, 1.0f), 1) << to_string(rate);
  }
}

}  // namespace
}  // namespace signweave
