#include "signweave/evaluation/spans.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "signweave/core/atomic_file.h"
#include "signweave/evaluation/path_measures.h"
#include "signweave/evaluation/test_recording.h"

namespace signweave {
namespace {

std::vector<double> speeds_of(const EvaluatedMotion& recording, Side side) {
  std::vector<double> speeds;
  PathFit(recording.motion.rate()).speeds(recording.tracks[static_cast<std::size_t>(side)].wrist, speeds);
  return speeds;
}

std::size_t group_named(const SpanChoice& choice, const std::string& name) {
  return static_cast<std::size_t>(std::find(choice.groups.begin(), choice.groups.end(), name) - choice.groups.begin());
}

TEST(Spans, OfOneGroupDoNotOverlapAndHaveTheirLength) {
  const std::vector<EvaluatedMotion> recordings = {lively("a", 0.1), lively("b", 2.0)};
  const SpanChoice choice = choose_spans(recordings);
  std::vector<std::size_t> counts(choice.groups.size());
  for (std::size_t i = 0; i < choice.spans.size(); ++i) {
    const EvaluatedSpan& span = choice.spans[i];
    ++counts[span.group];
    EXPECT_GE(span.frames.begin, 18) << "0.3 s of context";
    EXPECT_LE(span.frames.end, 900 - 18);
    if (i == 0 || choice.spans[i - 1].group != span.group || choice.spans[i - 1].recording != span.recording) continue;
    EXPECT_LE(choice.spans[i - 1].frames.end, span.frames.begin);
  }
  const std::vector<std::int64_t> frames = {10, 17, 31, 44, 64};
  for (std::size_t length = 0; length < frames.size(); ++length) {
    EXPECT_GT(counts[1 + length], 4u) << choice.groups[1 + length];
    for (const EvaluatedSpan& span : choice.spans) {
      if (span.group == 1 + length) {
        EXPECT_EQ(span.frames.size(), frames[length]);
      }
    }
  }
  EXPECT_GT(counts[group_named(choice, "natural")], 10u);
  EXPECT_EQ(counts[group_named(choice, "annotated")], 0u);
}

TEST(Spans, ThePeakOfSpeedIsInside) {
  const std::vector<EvaluatedMotion> recordings = {lively("a", 0.7)};
  const SpanChoice choice = choose_spans(recordings);
  for (const EvaluatedSpan& span : choice.spans) {
    // For one of the hands, no frame of the span or its borders is faster than the middle one.
    bool inside = false;
    for (const Side side : kSides) {
      const std::vector<double> speeds = speeds_of(recordings[0], side);
      const auto begin = speeds.begin() + span.frames.begin - 1;
      const auto peak = std::max_element(begin, speeds.begin() + span.frames.end + 1) - begin;
      inside = inside || (peak > 0 && peak <= span.frames.size() && *(begin + peak) >= kLeastPeak);
    }
    EXPECT_TRUE(inside) << choice.groups[span.group] << " at " << span.frames.begin;
  }
}

TEST(Spans, ASpanIsFastestInItsMiddle) {
  // A fast movement around frame 22, too near to the begin for a long span, and a slower one at frame 52.
  const auto swing = [](double t) {
    return 0.5 * std::tanh(16 * (t - 22.0 / 60)) + 0.3 * std::tanh(16 * (t - 52.0 / 60));
  };
  const std::vector<EvaluatedMotion> recordings = {recording_of("a", swinging(
                                                                         swing, [](double) { return 0.3; }, 240))};
  const SpanChoice choice = choose_spans(recordings);
  std::vector<FrameRange> about_the_second;
  for (const EvaluatedSpan& span : choice.spans) {
    if (choice.is_fixed(span.group) && span.frames.begin <= 52 && 52 < span.frames.end) {
      about_the_second.push_back(span.frames);
    }
  }
  // 170 to 735 ms; a span of 1064 ms would contain the first movement.
  EXPECT_THAT(about_the_second,
              testing::ElementsAre(FrameRange{47, 57}, FrameRange{44, 61}, FrameRange{37, 68}, FrameRange{30, 74}));
}

TEST(Spans, NaturalMovementsExtendFromValleyToValley) {
  // A periodic swing: the speed is least where it reverses.
  const auto swing = [](double t) { return 0.6 - 0.6 * std::cos(4 * t); };
  const std::vector<EvaluatedMotion> recordings = {recording_of("a", swinging(
                                                                         swing, [](double) { return 0.3; }, 600))};
  const SpanChoice choice = choose_spans(recordings);
  std::size_t found = 0;
  for (const EvaluatedSpan& span : choice.spans) {
    if (span.group != group_named(choice, "natural")) continue;
    ++found;
    const double half = 3.14159265 / 4 * 60;  // frames from turn to turn
    EXPECT_NEAR(static_cast<double>(span.frames.size()), half - 1, 2);
    const double turns = static_cast<double>(span.frames.begin - 1) / half;
    EXPECT_NEAR(turns, std::round(turns), 0.05);
    EXPECT_EQ(span.moving, Side::left);
    EXPECT_EQ(span.peaks, 1u);
  }
  EXPECT_GE(found, 10u);
  EXPECT_LE(found, 12u);
}

TEST(Spans, LongSpansCountTheirPeaks) {
  const auto swing = [](double t) { return 0.6 - 0.6 * std::cos(4 * t); };
  const EvaluatedMotion recording = recording_of("a", swinging(
                                                          swing, [](double) { return 0.3; }, 600));
  EXPECT_EQ(span_at(recording, 0, {50, 90}, 0).peaks, 1u);   // about one half turn of 47 frames
  EXPECT_EQ(span_at(recording, 0, {96, 188}, 0).peaks, 2u);  // two of them
  EXPECT_FALSE(span_at(recording, 0, {50, 90}, 0).is_long);
  EXPECT_TRUE(span_at(recording, 0, {96, 188}, 0).is_long);
}

TEST(Spans, SpansWithDefectsAreLeftOutAndCounted) {
  std::vector<EvaluatedMotion> recordings = {lively("a", 0.7)};
  const std::size_t before = choose_spans(recordings).spans.size();
  EXPECT_EQ(choose_spans(recordings).left_out, 0u);
  for (std::size_t frame = 300; frame < 420; ++frame) recordings[0].unusable[frame] = true;
  const SpanChoice choice = choose_spans(recordings);
  EXPECT_GT(choice.left_out, 5u);
  EXPECT_LT(choice.spans.size(), before);
  for (const EvaluatedSpan& span : choice.spans) EXPECT_TRUE(span.frames.end <= 300 || span.frames.begin >= 420);
}

TEST(Spans, AnnotatedTransitionsAreThoseBetweenStrokes) {
  const auto sign = [](std::string gloss, Milliseconds begin) {
    Sign one{.gloss = std::move(gloss),
             .span = {begin, begin + 600ms},
             .phases = {},
             .signer = "",
             .tier = "Gloss",
             .annotation = ""};
    one.phases.push_back({PhaseKind::preparation, {begin, begin + 200ms}, "", ""});
    one.phases.push_back({PhaseKind::stroke, {begin + 200ms, begin + 500ms}, "", ""});
    one.phases.push_back({PhaseKind::retraction, {begin + 500ms, begin + 600ms}, "", ""});
    return one;
  };
  EvaluatedMotion recording = lively("a", 0.7);
  recording.signs = {sign("A", 1'000ms), sign("B", 1'600ms), sign("C", 2'200ms)};
  const SpanChoice choice = choose_spans(std::vector{recording});
  std::vector<FrameRange> annotated;
  for (const EvaluatedSpan& span : choice.spans) {
    if (span.group == 0) annotated.push_back(span.frames);
  }
  EXPECT_THAT(annotated, testing::ElementsAre(FrameRange{90, 108}, FrameRange{126, 144}));
}

TEST(Recordings, UnusableRecordingsAreReportedInOneLine) {
  const auto message = [](const auto& make) -> std::string {
    try {
      make();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const auto still = [](double) { return 0.3; };
  EXPECT_EQ(message([&] { recording_of("a.bvh", swinging(still, still, 3)); }),
            "a.bvh: only 3 frames, so nothing can be cut out");
  Motion motion = swinging(still, still, 30);
  EXPECT_EQ(
      message([&] { evaluated_motion("b.bvh", motion, RigMap{}, {}, FrameClock{}); }),
      "b.bvh: no wrist is known, so there is nothing to compare; a mapping file can name left_hand and right_hand");
}

struct SpanTable : testing::Test {
  std::vector<EvaluatedMotion> recordings = {lively("corpus/a.bvh", 0.7, 200), lively("corpus/b.bvh", 0.9, 200),
                                             lively("other/b.bvh", 1.9, 200)};
  std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      (std::string("spans_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv");
  ~SpanTable() override { std::filesystem::remove(path); }

  SpanChoice read(const std::string& text) {
    std::ofstream(path) << text;
    return read_spans(path, recordings);
  }
  std::string error_of(const std::string& text) {
    try {
      read(text);
    } catch (const Error& error) {
      return std::string(error.what()).substr(path.string().size());
    }
    return "none";
  }
};

TEST_F(SpanTable, IsReadWithOrWithoutHeadingGroupsAndQuotes) {
  const SpanChoice choice = read("file,first frame,frames,group\n\"a\", 20, 10, short\n\ncorpus/b.bvh,30,40,long\r\n");
  EXPECT_THAT(choice.groups, testing::ElementsAre("short", "long"));
  ASSERT_EQ(choice.spans.size(), 2u);
  EXPECT_EQ(choice.spans[0].recording, 0u);
  EXPECT_EQ(choice.spans[0].frames, (FrameRange{20, 30}));
  EXPECT_EQ(choice.spans[1].recording, 1u);
  EXPECT_EQ(choice.spans[1].frames, (FrameRange{30, 70}));
  recordings[0].name = "a";  // as in a database
  EXPECT_EQ(read("a.bvh,20,10\n").spans[0].recording, 0u);
  EXPECT_THAT(read("a.bvh,20,10\n").groups, testing::ElementsAre("table"));
}

TEST_F(SpanTable, ErrorsNameTheLine) {
  EXPECT_EQ(error_of("a,20,10\nb,20,10\n"), ":2: 'b' is the name of 2 recordings; give its folder too");
  EXPECT_EQ(error_of("aa.bvh,20,10\n"), ":1: no evaluated recording is named 'aa.bvh'; did you mean a.bvh or b.bvh?");
  EXPECT_EQ(error_of("file,first,frames\na,20\n"),
            ":2: 2 columns; a row has file, first frame, frames, and may have a group");
  EXPECT_EQ(error_of("a,x,10\n"), ":1: the first frame 'x' is not a whole number");
  EXPECT_EQ(error_of("a,20,1.5\n"), ":1: the number of frames '1.5' is not a whole number");
  const std::string outside = " leave no frame on both sides of a (frames 0 to 199); both its neighbours must be there";
  EXPECT_EQ(error_of("a,0,10\n"), ":1: 10 frames from frame 0" + outside);
  EXPECT_EQ(error_of("a,190,10\n"), ":1: 10 frames from frame 190" + outside);
  EXPECT_EQ(error_of("a,20,0\n"), ":1: 0 frames from frame 20" + outside);
  EXPECT_EQ(error_of("a,20,9223372036854775807\n"), ":1: 9223372036854775807 frames from frame 20" + outside);
  EXPECT_EQ(error_of("\"a,20,10\n"), ":1: a quote is opened and never closed; close it");
}

}  // namespace
}  // namespace signweave
