#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "signweave/query/corpus_for_tests.h"
#include "signweave/query/explain.h"
#include "signweave/query/find.h"
#include "signweave/query/movement_check.h"
#include "signweave/query/movement_for_tests.h"
#include "signweave/query/parse.h"
#include "signweave/query/queries_for_tests.h"
#include "signweave/query/rank.h"

namespace signweave {
namespace {

/// The lines of the blocks that begin with ```KIND in docs/query.md.
std::vector<std::string> documented(const std::string& kind) {
  std::ifstream file(SIGNWEAVE_SOURCE_DIR "/docs/query.md");
  std::vector<std::string> result;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("```")) {
      inside = line == "```" + kind;
    } else if (inside && !line.empty()) {
      result.push_back(line);
    }
  }
  return result;
}

TEST(Documentation, EveryExampleHasAnAnswer) {
  const std::vector<std::string> queries = documented("query");
  ASSERT_GE(queries.size(), 30U);
  const Segments table = weather_corpus().table();
  const std::unique_ptr<TestMovement> movement = weather_movement(table);
  for (const std::string& text : queries) {
    try {
      const PhaseQuery query = parse(text);
      EXPECT_FALSE(find(query, table, {}, movement.get()).empty()) << text;
      EXPECT_TRUE(hints(query, table).empty()) << text;
      EXPECT_EQ(parse(to_string(query)), query) << text;
      EXPECT_FALSE(explain(query, table).empty()) << text;
    } catch (const SyntaxError& error) {
      ADD_FAILURE() << text << '\n' << error.what() << '\n' << error.caret;
    }
  }
}

TEST(Movement, ASearchFindsTheRowsForWhichTheConditionHolds) {
  const Segments segments = weather_corpus().table();
  const std::unique_ptr<TestMovement> movement = weather_movement(segments);
  std::mt19937 random(3);
  RandomQueries queries(random, true);
  std::size_t answers = 0;
  for (int i = 0; i < 400; ++i) {
    PhaseQuery query;
    query.elements.push_back({{queries.moving(), false}, {}});
    const Condition& condition = query.elements.front().term.expression.condition;
    MovementCheck check(condition, movement.get());
    std::vector<RowId> expected;
    for (std::uint32_t recording = 0; recording < segments.recording_count(); ++recording) {
      const SegmentTable::RowRange range = segments.recording_rows(recording);
      for (RowId row = range.begin; row < range.end; ++row) {
        if (segments.kind(row) != RowKind::sign) continue;
        const Hand hand = segments.hand(row);
        const MovingRow moving{.row = row - range.begin,
                               .recording = recording,
                               .any_hand = hand == Hand::both,
                               .hand = hand == Hand::left ? Side::left : Side::right};
        const MeasuredSpans strokes = [&] {
          std::vector<TimeSpan> result;
          for (const RowId child : segments.children(row)) {
            if (segments.phase(child) == PhaseKind::stroke) result.push_back(segments.span(child));
          }
          return result;
        };
        if (check.holds(moving, strokes)) expected.push_back(row);
      }
    }
    std::vector<RowId> found;
    for (const Segment& segment : find(query, segments, {}, movement.get())) found.push_back(segment.row);
    std::ranges::sort(found);
    EXPECT_EQ(found, expected) << to_string(query);
    answers += found.size();
  }
  EXPECT_GT(answers, 300U);
}

TEST(Movement, LikeOrdersTheAnswersByDistance) {
  const Segments segments = weather_corpus().table();
  const std::unique_ptr<TestMovement> movement = weather_movement(segments);
  const PhaseQuery query = parse("phase = stroke & like(\"meteo\"@1000..1400)");
  const std::vector<Segment> all = find(query, segments, {}, movement.get());
  ASSERT_EQ(all.size(), find(parse("phase = stroke"), segments).size());
  const auto shape = [&](const Segment& segment) {
    const std::uint32_t recording = segments.find_recording(segment.recording);
    const std::shared_ptr<const HandTrace> trace = movement->hands(recording);
    const FrameRange frames = measured_frames(segment.span, movement->clock(recording), trace->frames);
    Shape result(2);
    resample(*trace, TracePoint::right_palm, frames, result[0]);
    resample(*trace, TracePoint::left_palm, frames, result[1]);
    return result;
  };
  EXPECT_EQ(all.front().span, (TimeSpan{1'000ms, 1'400ms}));
  EXPECT_EQ(all.front().distance, 0);
  float before = 0;
  for (const Segment& segment : all) {
    EXPECT_EQ(segment.distance, warped_distance(shape(all.front()), shape(segment))) << segment.name;
    EXPECT_GE(*segment.distance, before);
    before = *segment.distance;
  }
  FindLimits limits;
  limits.limit = 3;
  EXPECT_EQ(find(query, segments, limits, movement.get()), std::vector<Segment>(all.begin(), all.begin() + 3));
  limits.limit = 0;
  EXPECT_TRUE(find(query, segments, limits, movement.get()).empty());
}

TEST(Movement, AnIncompleteExampleIsReported) {
  const Segments segments = weather_corpus().table();
  const std::unique_ptr<TestMovement> movement = weather_movement(segments);
  const auto fault = [&](const char* text, const Movement* source) -> std::string {
    try {
      find(parse(text), segments, {}, source);
    } catch (const Error& error) {
      return error.what();
    }
    return "no fault";
  };
  EXPECT_THAT(fault("like(\"metteo\"@1..2)", movement.get()), testing::HasSubstr("did you mean meteo?"));
  EXPECT_THAT(fault("like(\"meteo\"@20000..20100)", movement.get()), testing::HasSubstr("lies outside the motion"));
  EXPECT_THAT(fault("like(\"meteo\"@1..200, left_knee)", movement.get()),
              testing::HasSubstr("'left_knee' is not known"));
  EXPECT_THAT(fault("like(\"meteo\"@1..200)", nullptr), testing::HasSubstr("there is no motion"));
}

}  // namespace
}  // namespace signweave
