#include "signweave/core/time.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

namespace signweave {

void PrintTo(FrameRate rate, std::ostream* out) {
  *out << rate.numerator << '/' << rate.denominator;
}

namespace {

struct Case {
  std::string text;
  FrameRate rate;
  bool snapped;
};

TEST(SnapFrameTime, APrintedFrameTimeGivesTheStandardRateWithTheSameText) {
  const std::vector<Case> cases = {
      {"0.033333", {30, 1}, true},
      {"0.0333333", {30, 1}, true},
      {".03333", {30, 1}, true},
      {"0.0333", {30, 1}, true},
      {"0.033", {30, 1}, true},
      {"3.33333e-2", {30, 1}, true},
      {"0.03333333333333333", {30, 1}, false},
      {"0.0333667", {30000, 1001}, true},
      {"0.033367", {30000, 1001}, true},
      {"0.008333", {120, 1}, true},
      {".0083333", {120, 1}, true},
      {"0.0083", {120, 1}, true},
      {"0.008342", {120000, 1001}, true},
      {"0.016667", {60, 1}, true},
      {"0.017", {60, 1}, true},
      {"0.0167", {60, 1}, true},
      {"0.0417", {24, 1}, true},
      {"0.041667", {24, 1}, true},
      {"0.0417083", {24000, 1001}, true},
      {"0.010000", {100, 1}, false},
      {"0.01", {100, 1}, false},
      {"0.04", {25, 1}, false},
      {"+0.02", {50, 1}, false},
      {"0.005", {200, 1}, false},
      {"1", {1, 1}, false},
  };
  for (const Case& one : cases) {
    const std::optional<SnappedRate> found = snap_frame_time(one.text);
    ASSERT_TRUE(found) << one.text;
    EXPECT_EQ(found->rate, one.rate) << one.text;
    EXPECT_EQ(found->snapped, one.snapped) << one.text;
  }
}

TEST(SnapFrameTime, DigitsMayBeTruncatedInsteadOfRounded) {
  EXPECT_EQ(snap_frame_time("0.0166")->rate, (FrameRate{60, 1}));
  EXPECT_EQ(snap_frame_time("0.01666")->rate, (FrameRate{60, 1}));
  EXPECT_EQ(snap_frame_time("0.0416")->rate, (FrameRate{24, 1}));
}

TEST(SnapFrameTime, DecimalNtscRatesAreTakenLiterally) {
  EXPECT_EQ(snap_frame_time("0.0417083750417")->rate, (FrameRate{2997, 125}));
  EXPECT_EQ(snap_frame_time("0.03336670003")->rate, (FrameRate{2997, 100}));
}

TEST(SnapFrameTime, AnyOtherTextIsExactlyTheDecimalPrinted) {
  EXPECT_EQ(snap_frame_time("0.03")->rate, (FrameRate{100, 3}));
  EXPECT_EQ(snap_frame_time("0.0123")->rate, (FrameRate{10000, 123}));
  EXPECT_EQ(snap_frame_time("2")->rate, (FrameRate{1, 2}));
  EXPECT_FALSE(snap_frame_time("0.0123")->snapped);
}

TEST(SnapFrameTime, OtherTextThanAFrameTimeHasNoRate) {
  for (const char* text : {"", "0", "-0.01", "nan", "inf", "abc", "0.01s", "0,01", "1e-7", "1e5", "0.01 0.02"}) {
    EXPECT_FALSE(snap_frame_time(text)) << text;
  }
}

RC_GTEST_PROP(SnapFrameTime, AnyNumberGivesANearbyRateOrNone, ()) {
  const double seconds =
      *rc::gen::map(rc::gen::inRange(-6'000'000, 4'000'000), [](int power) { return std::pow(10.0, power * 1e-6); });
  const int digits = *rc::gen::inRange(1, 18);
  const std::string text = fmt::format("{:.{}g}", seconds, digits);
  const std::optional<SnappedRate> rate = snap_frame_time(text);
  const double printed = std::stod(text);
  if (printed < 1e-6 || printed > 1e4) {
    RC_ASSERT(!rate);
  } else {
    RC_ASSERT(rate.has_value());
    RC_ASSERT(rate->rate.numerator > 0);
    RC_ASSERT(rate->rate.denominator > 0);
    RC_ASSERT(std::abs(rate->rate.frame_time().count() / printed - 1) < 0.026);
  }
}

TEST(ParseFrameRate, AcceptsWholeNumbersDecimalsAndFractions) {
  EXPECT_EQ(parse_frame_rate("100"), (FrameRate{100, 1}));
  EXPECT_EQ(parse_frame_rate("29.97"), (FrameRate{30000, 1001}));
  EXPECT_EQ(parse_frame_rate("23.976"), (FrameRate{24000, 1001}));
  EXPECT_EQ(parse_frame_rate("30000/1001"), (FrameRate{30000, 1001}));
  EXPECT_EQ(parse_frame_rate("12.5"), (FrameRate{25, 2}));
  EXPECT_EQ(parse_frame_rate("60/2"), (FrameRate{30, 1}));
}

TEST(ParseFrameRate, OtherTextIsRefused) {
  for (const char* text : {"", "0", "-30", "30/0", "30/", "/1", "1e99", "abc", "30fps", "1.5/2", "nan", "99999999"}) {
    EXPECT_FALSE(parse_frame_rate(text)) << text;
  }
}

TEST(ToString, GivesTextThatParsesBack) {
  for (const char* text : {"120", "30000/1001", "12.5", "23.5"}) EXPECT_EQ(to_string(*parse_frame_rate(text)), text);
}

TEST(FramesOf, AdjacentPhasesShareNoFrame) {
  const FrameClock clock{.frame_time = Seconds(1.0 / 30.0), .origin = 120ms};
  const FrameRange preparation = frames_of({1'000ms, 1'217ms}, clock);
  const FrameRange stroke = frames_of({1'217ms, 1'583ms}, clock);
  EXPECT_EQ(preparation, (FrameRange{26, 33}));
  EXPECT_EQ(stroke.begin, preparation.end);
}

RC_GTEST_PROP(FramesOf, ASpanOfWholeFramesRoundTrips, ()) {
  const FrameClock clock{.frame_time = Seconds(1.0 / *rc::gen::inRange(1, 400)),
                         .origin = Milliseconds(*rc::gen::inRange(-100'000, 100'000))};
  const std::int64_t begin = *rc::gen::inRange(0, 1'000'000);
  const FrameRange range{begin, begin + *rc::gen::inRange(0, 10'000)};
  const TimeSpan span = span_of(range, clock);
  // A frame is longer than the millisecond to which a span is rounded.
  RC_ASSERT(frames_of(span, clock) == range);
}

TEST(FramesOf, ATimeFarOutsideDoesNotOverflow) {
  const FrameClock clock{.frame_time = Seconds(1e-6), .origin = 0ms};
  const FrameRange range = frames_of({Milliseconds::min(), Milliseconds::max()}, clock);
  EXPECT_LT(range.begin, 0);
  EXPECT_GT(range.end, 0);
}

TEST(Clamp, LimitsARangeToExistingFrames) {
  EXPECT_EQ(clamp({-5, 3}, 10), (FrameRange{0, 3}));
  EXPECT_EQ(clamp({8, 30}, 10), (FrameRange{8, 10}));
  EXPECT_TRUE(clamp({20, 30}, 10).empty());
  EXPECT_TRUE(clamp({7, 3}, 10).empty());
}

TEST(TimeSpan, AdjacentSpansDoNotOverlap) {
  EXPECT_FALSE((TimeSpan{0ms, 10ms}.overlaps({10ms, 20ms})));
  EXPECT_TRUE((TimeSpan{0ms, 11ms}.overlaps({10ms, 20ms})));
  EXPECT_TRUE((TimeSpan{0ms, 20ms}.contains({10ms, 20ms})));
  EXPECT_FALSE((TimeSpan{0ms, 19ms}.contains({10ms, 20ms})));
}

}  // namespace
}  // namespace signweave
