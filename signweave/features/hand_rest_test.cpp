#include "signweave/features/hand_rest.h"

#include <gtest/gtest.h>

namespace signweave {
namespace {

/// A left palm at some heights, in shoulder widths, at 50 frames a second with two frames a sample; hips at −1.
HandTrace trace_of(const std::vector<float>& heights) {
  HandTrace trace{.why_not = {}, .rate = {50, 1}, .frames = 2 * static_cast<std::int64_t>(heights.size()), .step = 2};
  trace.body.heights[static_cast<std::size_t>(Height::waist)] = -1;
  std::vector<TraceSample>& palm = trace.points[static_cast<std::size_t>(TracePoint::left_palm)];
  for (const float height : heights) {
    TraceSample& sample = palm.emplace_back();
    sample.position[1] = static_cast<std::int16_t>(height / TraceSample::kPosition);
  }
  return trace;
}

TEST(HandRest, IsWhereTheHandIsLowestAndStill) {
  HandTrace trace = trace_of({0, -0.5f, -0.9f, -0.8f, 0, 0, 0, -0.5f, 0, 0});
  EXPECT_EQ(hand_rest(trace, Side::left, 0), (FrameRange{2, 6}));
  trace.points[0][2].velocity = {1000, 0, 0};  // a metre a second
  EXPECT_EQ(hand_rest(trace, Side::left, 0), (FrameRange{4, 8}));
}

TEST(HandRest, OfEquallyLowMomentsIsTheNearest) {
  const HandTrace trace = trace_of({-1.2f, 0, 0, -1, 0, 0, 0, -3});
  EXPECT_EQ(hand_rest(trace, Side::left, 1), (FrameRange{0, 2}));
  EXPECT_EQ(hand_rest(trace, Side::left, 8), (FrameRange{4, 8}));
  EXPECT_EQ(hand_rest(trace, Side::left, 90), (FrameRange{12, 16}));
}

TEST(HandRest, OfAHandWithoutATraceIsUnknown) {
  EXPECT_FALSE(hand_rest(trace_of({0}), Side::right, 0));
  EXPECT_FALSE(hand_rest(trace_of({}), Side::left, 0));
}

}  // namespace
}  // namespace signweave
