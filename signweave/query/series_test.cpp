#include "signweave/query/series_over.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "signweave/query/corpus_for_tests.h"
#include "signweave/query/explain.h"
#include "signweave/query/find.h"
#include "signweave/query/movement_for_tests.h"
#include "signweave/query/parse.h"
#include "signweave/query/queries_for_tests.h"

namespace signweave {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Given tracks, ten frames per second, the same for every recording except those without tracks.
class MadeTracks : public Movement {
 public:
  std::map<std::string, std::vector<float>, std::less<>> values;
  std::vector<Gaze> eyes;
  std::set<std::uint32_t> faceless;
  mutable std::vector<FrameRange> read;

  ColumnValues column(Column, std::uint32_t) const override { return {}; }
  float shoulder_width(std::uint32_t) const override { return 0; }
  FrameClock clock(std::uint32_t) const override { return {.frame_time = Seconds(0.1)}; }
  std::shared_ptr<const HandTrace> hands(std::uint32_t) const override { return std::make_shared<const HandTrace>(); }
  std::vector<PointTrack> points(std::uint32_t, std::span<const Part>, FrameRange) const override { return {}; }
  std::int64_t frame_count(std::uint32_t) const override {
    return static_cast<std::int64_t>(values.empty() ? eyes.size() : values.begin()->second.size());
  }
  std::vector<float> track(std::uint32_t recording, std::string_view name, FrameRange frames) const override {
    read.push_back(frames);
    const auto at = values.find(name);
    if (at == values.end() || faceless.contains(recording)) return {};
    return {at->second.begin() + frames.begin, at->second.begin() + frames.end};
  }
  std::vector<Gaze> gaze(std::uint32_t, FrameRange frames) const override {
    if (eyes.empty()) return {};
    return {eyes.begin() + frames.begin, eyes.begin() + frames.end};
  }
  bool has_track(std::string_view name) const override { return values.find(name) != values.end(); }
  std::vector<std::string> tracks() const override {
    std::vector<std::string> names;
    for (const auto& [name, all] : values) names.push_back(name);
    return names;
  }
};

MovementTerm term_of(const std::string& text) {
  return parse(text + (text.find("gaze") != text.npos ? " > 0 deg" : " > 0"))
      .elements.front()
      .term.expression.condition.movement;
}

class Series : public testing::Test {
 protected:
  Series() {
    tracks_.values["jawOpen"] = {0.1f, 0.2f, 0.9f, 0.4f, 0.3f, 0.0f};
    tracks_.values["tilt"] = {-0.5f, -0.2f, -0.4f, 0.1f, 0.3f, std::numeric_limits<float>::quiet_NaN()};
    tracks_.eyes = {{10, 1}, {-20, 2}, {4, -30}, {0, 0}, {0, 0}, {0, 0}};
  }
  float at(const std::string& text, std::vector<TimeSpan> spans) const {
    return series_over(term_of(text), tracks_, 0, spans);
  }
  MadeTracks tracks_;
};

TEST_F(Series, HasMaximumMinimumMeanAndBothEnds) {
  const std::vector<TimeSpan> span = {{100ms, 500ms}};  // frames 1 to 4
  EXPECT_FLOAT_EQ(at("track(jawOpen)", span), 0.9f);
  EXPECT_FLOAT_EQ(at("track(jawOpen).least", span), 0.2f);
  EXPECT_FLOAT_EQ(at("mean_track(jawOpen)", span), 0.45f);  // (0.2 + 0.9 + 0.4 + 0.3) / 4
  EXPECT_FLOAT_EQ(at("track(jawOpen).begin", span), 0.2f);
  EXPECT_FLOAT_EQ(at("track(jawOpen).end", span), 0.3f);
  EXPECT_FLOAT_EQ(at("track(tilt)", {{0ms, 300ms}}), -0.2f) << "the maximum, not the value farthest from 0";
  EXPECT_FLOAT_EQ(at("track(tilt).least", {{0ms, 300ms}}), -0.5f);
}

TEST_F(Series, GazeIsQueriedByAngle) {
  const std::vector<TimeSpan> span = {{0ms, 300ms}};
  EXPECT_FLOAT_EQ(at("gaze(yaw)", span), 10);
  EXPECT_FLOAT_EQ(at("gaze(yaw).least", span), -20);
  EXPECT_FLOAT_EQ(at("mean_gaze(yaw)", span), -2);  // (10 - 20 + 4) / 3
  EXPECT_FLOAT_EQ(at("gaze(pitch)", span), 2);
  EXPECT_FLOAT_EQ(at("gaze(pitch).end", span), -30);
}

TEST_F(Series, SeveralSpansAreTakenTogether) {
  const std::vector<TimeSpan> strokes = {{0ms, 100ms}, {300ms, 500ms}};  // frames 0, 3 and 4
  EXPECT_FLOAT_EQ(at("track(jawOpen)", strokes), 0.4f);
  EXPECT_FLOAT_EQ(at("track(jawOpen).least", strokes), 0.1f);
  EXPECT_FLOAT_EQ(at("mean_track(jawOpen)", strokes), 0.8f / 3);
  EXPECT_FLOAT_EQ(at("track(jawOpen).begin", strokes), 0.1f);
  EXPECT_FLOAT_EQ(at("track(jawOpen).end", strokes), 0.3f);
}

TEST_F(Series, ASegmentIsMeasuredAsFarAsTheMotionGoes) {
  EXPECT_FLOAT_EQ(at("track(jawOpen)", {{400ms, 2'000ms}}), 0.3f);
  EXPECT_FLOAT_EQ(at("track(jawOpen)", {{210ms, 220ms}}), 0.9f) << "shorter than a frame";
  EXPECT_TRUE(std::isnan(at("track(jawOpen)", {{700ms, 900ms}})));
  EXPECT_TRUE(std::isnan(at("track(jawOpen)", {{0ms, 100ms}, {700ms, 900ms}})));
  EXPECT_TRUE(std::isnan(at("track(jawOpen)", {}))) << "a sign without stroke";
}

TEST_F(Series, AMissingOrNanValueIsNotKnown) {
  EXPECT_TRUE(std::isnan(at("track(mouthLeft)", {{0ms, 300ms}})));
  EXPECT_TRUE(std::isnan(at("track(tilt)", {{300ms, 600ms}})));
  EXPECT_TRUE(std::isnan(at("track(tilt).begin", {{300ms, 600ms}})));
  tracks_.eyes.clear();
  EXPECT_TRUE(std::isnan(at("gaze(yaw)", {{0ms, 300ms}})));
}

TEST_F(Series, ALongSegmentIsReadInBlocks) {
  tracks_.values.clear();
  std::vector<float>& long_one = tracks_.values["jawOpen"];
  for (int i = 0; i < 2'000; ++i) long_one.push_back(static_cast<float>(i % 7));
  long_one[1'234] = 8;
  EXPECT_EQ(at("track(jawOpen)", {{0ms, 200'000ms}}), 8);
  EXPECT_EQ(tracks_.read.size(), 4U);
  for (const FrameRange piece : tracks_.read) EXPECT_LE(piece.size(), kPiece);
}

/// Three signs of one recording and one of another, which has no face.
Segments three_signs() {
  TestCorpus corpus;
  corpus.recording("face").tier("Gloss").tier("Phase", "Gloss");
  corpus.sign("Gloss", "A", {0ms, 200ms}, {{PhaseKind::stroke, 200ms}});
  corpus.sign("Gloss", "B", {200ms, 400ms}, {{PhaseKind::stroke, 300ms}, {PhaseKind::hold, 400ms}});
  corpus.sign("Gloss", "C", {400ms, 600ms}, {{PhaseKind::stroke, 600ms}});
  corpus.recording("none").tier("Gloss").tier("Phase", "Gloss");
  corpus.sign("Gloss", "D", {0ms, 200ms}, {{PhaseKind::stroke, 200ms}});
  return corpus.table();
}

class SeriesSearch : public Series {
 protected:
  SeriesSearch() { tracks_.faceless = {1}; }
  std::vector<std::string> found(const std::string& text) const {
    std::vector<std::string> names;
    for (const Segment& segment : find(parse(text), segments_, {}, &tracks_)) names.push_back(segment.name);
    return names;
  }
  Segments segments_ = three_signs();
};

TEST_F(SeriesSearch, FindsTheSignsWhoseStrokesMeetIt) {
  // A has 0.1 and 0.2, B 0.9 (its hold 0.4 does not count), C 0.3 and 0; D is not known.
  EXPECT_THAT(found("gloss =~ /.*/ & track(jawOpen) > 0.25"), ElementsAre("B", "C"));
  EXPECT_THAT(found("track(jawOpen) <= 0.35"), ElementsAre("A", "C"));
  EXPECT_THAT(found("track(jawOpen).least < 0.1"), ElementsAre("C"));
  EXPECT_THAT(found("mean_track(jawOpen) > 0.14 & track(jawOpen) < 0.85"), ElementsAre("A", "C"));
  EXPECT_THAT(found("phase = hold & track(jawOpen) > 0.35"), ElementsAre("B hold"));
  EXPECT_THAT(found("gaze(yaw).least < -15 deg & !(gloss = D)"), ElementsAre("A"));
  EXPECT_THAT(found("gloss = A -> track(jawOpen) > 0.5"), ElementsAre("A B"));
  EXPECT_THAT(found("phase = stroke & parent(track(jawOpen) > 0.5)"), ElementsAre("B stroke"));
}

TEST_F(SeriesSearch, AnUnknownValueMeetsOnlyANegation) {
  EXPECT_THAT(found("gloss = D & track(jawOpen) > 0.1"), ElementsAre());
  EXPECT_THAT(found("gloss = D & track(jawOpen) <= 0.1"), ElementsAre());
  EXPECT_THAT(found("gloss = D & !(track(jawOpen) > 0.1)"), ElementsAre("D"));
}

TEST_F(SeriesSearch, ReadsOnlyRowsThatMeetTheRestAndEachOnce) {
  EXPECT_THAT(found("track(jawOpen) > 0.1 & duration < 1s & begin >= 400ms"), ElementsAre("C"));
  EXPECT_THAT(tracks_.read, ElementsAre(FrameRange{4, 6}));
  tracks_.read.clear();
  // Both phases of B query their sign, which is read once, as are those of A, C and D.
  EXPECT_THAT(found("phase =~ /.*/ & parent(track(jawOpen) > 0.8)"), ElementsAre("B stroke", "B hold"));
  EXPECT_EQ(tracks_.read.size(), 4U);
}

TEST_F(SeriesSearch, AnUnknownTrackIsAnErrorWithNearMatches) {
  const auto fault = [&](const std::string& text) -> std::string {
    try {
      found(text);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::not_found);
      return error.what();
    }
    return "no fault";
  };
  EXPECT_EQ(fault("gloss = A & !(track(jawOpn) > 0.1)"),
            "track(\"jawOpn\"): no recording of this database has such a scalar track; did you mean jawOpen?");
  EXPECT_THAT(fault("gloss = A overlaps (gloss = B -> mean_track(xyz) > 0)"), HasSubstr("mean_track(\"xyz\"): no"));
  EXPECT_THAT(fault("gloss = A & during(gloss = B -> track(xyz) > 0)"), HasSubstr("track(\"xyz\"): no recording"));
  tracks_.values.clear();
  EXPECT_THAT(fault("track(jawOpen) > 0"), HasSubstr("import a face capture, NAME.face.csv, with its motion"));
  EXPECT_NO_THROW(find(parse("track(jawOpen) > 0"), segments_)) << "no movement is known";
}

TEST_F(SeriesSearch, ThePlanStatesWhatIsReadLast) {
  EXPECT_THAT(explain(parse("gloss = A & track(jawOpen) > 0.1"), segments_),
              HasSubstr("2. keep those with gloss = \"A\" & track(\"jawOpen\") > 0.1; read from the motion if the rest "
                        "does not decide: track(\"jawOpen\") > 0.1\n"));
  EXPECT_THAT(explain(parse("gaze(yaw) > 3 deg"), segments_), HasSubstr("gaze(yaw) > 3 deg, read from the motion\n"));
}

TEST_F(SeriesSearch, StopsAtItsDeadline) {
  const std::atomic<bool> cancel = true;
  FindLimits limits;
  limits.cancel = &cancel;
  EXPECT_THROW(find(parse("track(jawOpen) > 0"), segments_, limits, &tracks_), Error);
}

/// Reads every frame of a row in the simplest way.
float plain_answer(const MovementTerm& term, const Movement& movement, std::uint32_t recording,
                   const std::vector<TimeSpan>& strokes) {
  std::vector<double> all;
  for (const TimeSpan span : strokes) {
    std::size_t inside = 0;
    for (std::int64_t frame = 0; frame < movement.frame_count(recording); ++frame) {
      // The frames whose time lies in the span: 60 per second, from annotation time 0.
      const FrameRange one = frames_of(span, movement.clock(recording));
      if (frame < one.begin || frame >= one.end) continue;
      ++inside;
      if (is_gaze(term.quantity)) {
        const std::vector<Gaze> gaze = movement.gaze(recording, {frame, frame + 1});
        if (gaze.empty()) return kNotKnown;
        all.push_back(static_cast<double>(term.angle == GazeAngle::yaw ? gaze[0].yaw : gaze[0].pitch));
      } else {
        const std::vector<float> values = movement.track(recording, term.track, {frame, frame + 1});
        if (values.empty()) return kNotKnown;
        all.push_back(static_cast<double>(values[0]));
      }
    }
    if (inside == 0) return kNotKnown;
  }
  if (all.empty()) return kNotKnown;
  if (term.component == Component::begin) return static_cast<float>(all.front());
  if (term.component == Component::end) return static_cast<float>(all.back());
  if (term.component == Component::least) return static_cast<float>(*std::ranges::min_element(all));
  if (term.quantity == Quantity::track || term.quantity == Quantity::gaze) {
    return static_cast<float>(*std::ranges::max_element(all));
  }
  double sum = 0;
  for (const double value : all) sum += value;
  return static_cast<float>(sum / static_cast<double>(all.size()));
}

RC_GTEST_PROP(SeriesProperty, ASearchFindsTheSameAsReadingEveryFrame, (std::uint32_t seed)) {
  std::mt19937 random(seed);
  const Segments segments = weather_corpus().table();
  static const std::unique_ptr<TestMovement> movement = weather_movement(segments);
  RandomQueries queries(random, true);
  for (int i = 0; i < 20;) {
    PhaseQuery query;
    query.elements.push_back({{queries.moving(), false}, {}});
    const Condition& condition = query.elements.front().term.expression.condition;
    if (!is_series(condition.movement.quantity)) continue;
    ++i;
    std::set<RowId> expected;
    for (std::uint32_t recording = 0; recording < segments.recording_count(); ++recording) {
      const SegmentTable::RowRange range = segments.recording_rows(recording);
      for (RowId row = range.begin; row < range.end; ++row) {
        if (segments.kind(row) != RowKind::sign) continue;
        std::vector<TimeSpan> strokes;
        for (const RowId child : segments.children(row)) {
          if (segments.phase(child) == PhaseKind::stroke) strokes.push_back(segments.span(child));
        }
        const float value = plain_answer(condition.movement, *movement, recording, strokes);
        const auto number = static_cast<double>(value);
        const double bound = std::get<Amount>(condition.value).value;
        const bool holds = condition.compare == Compare::less         ? number < bound
                           : condition.compare == Compare::less_equal ? number <= bound
                           : condition.compare == Compare::greater    ? number > bound
                                                                      : number >= bound;
        if (holds) expected.insert(row);
      }
    }
    std::set<RowId> found;
    for (const Segment& segment : find(query, segments, {}, movement.get())) found.insert(segment.row);
    RC_LOG() << to_string(query) << '\n';
    RC_ASSERT(found == expected);
  }
}

}  // namespace
}  // namespace signweave
