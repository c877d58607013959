#include "signweave/query/movement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "signweave/query/movement_check.h"
#include "signweave/query/movement_for_tests.h"
#include "signweave/query/parse.h"
#include "signweave/query/queries_for_tests.h"

namespace signweave {
namespace {

constexpr MovementRow annotation(TimeSpan span) {
  return {.span = span};
}
constexpr MovementRow sign(TimeSpan span) {
  return {.kind = RowKind::sign, .span = span};
}
constexpr MovementRow phase(PhaseKind kind, RowId parent, TimeSpan span) {
  return {.kind = RowKind::phase, .phase = kind, .parent = parent, .span = span};
}

TEST(Movement, EveryColumnHasAPlaceOfItsOwn) {
  std::set<std::size_t> places;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(HandMeasure::end_distance); ++i) {
    for (const Side side : kSides) places.insert(place_of({static_cast<HandMeasure>(i), side}));
  }
  EXPECT_EQ(places.size(), kMovementColumns);
  EXPECT_EQ(*places.rbegin(), kMovementColumns - 1);
}

TEST(Movement, AStateIsOneNumber) {
  for (unsigned bits = 0; bits < 8; ++bits) {
    const HandState state{.openness = static_cast<float>(bits) / 7,
                          .contact = static_cast<Contact>(bits),
                          .palm = static_cast<Facing>(bits % 7),
                          .fingers = static_cast<Facing>((bits + 2) % 7)};
    const Zone zone{.height = static_cast<Height>(bits), .reach = bits % 2 == 0 ? Reach::near : Reach::far};
    const std::uint32_t number = state_number(state, zone);
    EXPECT_EQ(number, static_cast<std::uint32_t>(static_cast<float>(number)));
    EXPECT_LT(number, 1U << 20U);
    const StateAndZone back = state_of(number);
    EXPECT_NEAR(back.state.openness, state.openness, 0.004);
    EXPECT_EQ(back.state.contact, state.contact);
    EXPECT_EQ(back.state.palm, state.palm);
    EXPECT_EQ(back.state.fingers, state.fingers);
    EXPECT_EQ(back.height, zone.height);
    EXPECT_EQ(back.reach, zone.reach);
  }
}

TEST(Movement, ARowShorterThanAFrameHasOneAndOneOutsideNone) {
  const FrameClock clock{.frame_time = Seconds(0.1)};
  EXPECT_EQ(measured_frames({200ms, 500ms}, clock, 10), (FrameRange{2, 5}));
  EXPECT_EQ(measured_frames({200ms, 210ms}, clock, 10), (FrameRange{2, 3}));
  EXPECT_EQ(measured_frames({800ms, 2'000ms}, clock, 10), (FrameRange{8, 10}));
  EXPECT_TRUE(measured_frames({1'800ms, 2'000ms}, clock, 10).empty());
}

TEST(Movement, PhasesHaveTheirFeaturesSignsThoseOfTheirStrokesOthersWhatTheTraceSays) {
  const TestMotion test(240, 11);
  const std::vector<MovementRow> rows = {annotation({0ms, 1'000ms}),
                                         sign({500ms, 2'000ms}),
                                         phase(PhaseKind::preparation, 1, {500ms, 800ms}),
                                         phase(PhaseKind::stroke, 1, {800ms, 1'200ms}),
                                         phase(PhaseKind::hold, 1, {1'200ms, 1'500ms}),
                                         phase(PhaseKind::stroke, 1, {1'500ms, 2'000ms})};
  std::vector<TimeSpan> spans;
  for (const MovementRow& row : rows) {
    if (row.kind == RowKind::phase) spans.push_back(row.span);
  }
  const RecordingFeatures features = measure_phases(test.motion, test.model, spans, test.clock);
  const HandTrace trace = trace_hands(test.motion, test.model);
  const MovementColumns columns = measure_rows(rows, features, trace, test.clock);
  const auto at = [&](HandMeasure measure, RowId row) { return columns[place_of({measure, Side::right})][row]; };
  const HandOver& first = features.phases[1].hands[1];
  const HandOver& second = features.phases[3].hands[1];
  EXPECT_EQ(at(HandMeasure::speed, 3), first.peak_speed);
  EXPECT_EQ(at(HandMeasure::mean_acceleration, 3), first.mean_acceleration);
  EXPECT_GE(at(HandMeasure::acceleration, 3), first.mean_acceleration);
  EXPECT_EQ(at(HandMeasure::begin_height, 3), first.begin.position.y());
  EXPECT_EQ(state_of(static_cast<std::uint32_t>(at(HandMeasure::end_state, 3))).height, first.end.zone.height);
  EXPECT_EQ(state_of(static_cast<std::uint32_t>(at(HandMeasure::end_state, 3))).reach, first.end.zone.reach);

  EXPECT_EQ(at(HandMeasure::speed, 1), std::max(first.peak_speed, second.peak_speed));
  EXPECT_FLOAT_EQ(at(HandMeasure::path, 1), first.path_length + second.path_length);
  EXPECT_NEAR(at(HandMeasure::mean_speed, 1), (24 * first.mean_speed + 30 * second.mean_speed) / 54, 1e-5);
  EXPECT_EQ(at(HandMeasure::begin_x, 1), first.begin.position.x());
  EXPECT_EQ(at(HandMeasure::end_x, 1), second.end.position.x());
  EXPECT_FLOAT_EQ(at(HandMeasure::displacement, 1),
                  (second.end.position - first.begin.position).norm() * trace.shoulder_width);
  EXPECT_FLOAT_EQ(at(HandMeasure::begin_distance, 1), features.phases[1].hands_distance_begin);
  EXPECT_EQ(at(HandMeasure::distance, 1), std::min(at(HandMeasure::distance, 3), at(HandMeasure::distance, 5)));
  EXPECT_LE(at(HandMeasure::distance, 3), features.phases[1].hands_distance_end);

  const PointTrack track = trace.track(TracePoint::right_palm, {0, 60});
  EXPECT_EQ(at(HandMeasure::path, 0), over(track, trace.rate, trace.shoulder_width).path_length);
}

TEST(Movement, SeveralStretchesAreJoinedByPeaksSumsAndMeans) {
  std::array<PointOver, 2> overs;
  overs[0].peak_speed = 1;
  overs[1].peak_speed = 3;
  overs[0].mean_speed = 1;
  overs[1].mean_speed = 2;
  overs[0].path_length = 0.1f;
  overs[1].path_length = 0.2f;
  overs[1].end.position = {1, 0, 0};
  const std::array<double, 2> frames = {10, 30};
  const PointOver all = join(overs, frames, 0.4f);
  EXPECT_EQ(all.peak_speed, 3);
  EXPECT_FLOAT_EQ(all.mean_speed, 1.75f);
  EXPECT_FLOAT_EQ(all.path_length, 0.3f);
  EXPECT_FLOAT_EQ(all.displacement, 0.4f);
}

TEST(Movement, WhatLiesOutsideTheMotionOrHasNoStrokeIsNotKnown) {
  const TestMotion test(60, 3);
  const std::vector<MovementRow> rows = {annotation({5'000ms, 6'000ms}),
                                         sign({0ms, 3'000ms}),
                                         phase(PhaseKind::stroke, 1, {0ms, 500ms}),
                                         phase(PhaseKind::stroke, 1, {2'000ms, 3'000ms}),
                                         sign({0ms, 500ms}),
                                         phase(PhaseKind::hold, 4, {0ms, 500ms})};
  const MovementColumns columns = measure_rows(rows, {}, trace_hands(test.motion, test.model), test.clock);
  for (std::size_t column = 0; column < columns.size(); ++column) {
    EXPECT_TRUE(std::isnan(columns[column][0])) << column;
    EXPECT_TRUE(std::isnan(columns[column][1])) << column;
    EXPECT_FALSE(std::isnan(columns[column][2])) << column;
    EXPECT_TRUE(std::isnan(columns[column][4])) << column;
    EXPECT_FALSE(std::isnan(columns[column][5])) << column;
  }
}

TEST(Movement, AHandThatTheRigLacksIsNotKnown) {
  TestMotion test(60, 3);
  test.model.rig[Part::left_hand] = {};
  const std::vector<MovementRow> rows = {annotation({0ms, 500ms})};
  const MovementColumns columns = measure_rows(rows, {}, trace_hands(test.motion, test.model), test.clock);
  EXPECT_TRUE(std::isnan(columns[place_of({HandMeasure::speed, Side::left})][0]));
  EXPECT_FALSE(std::isnan(columns[place_of({HandMeasure::speed, Side::right})][0]));
  EXPECT_TRUE(std::isnan(columns[place_of({HandMeasure::distance, Side::right})][0]));
}

Condition condition(const std::string& text) {
  return parse(text).elements.front().term.expression.condition;
}

/// Three rows of three hands with numbers of our own.
class Check : public testing::Test {
 protected:
  Check() : movement_(TestMovement::From::columns) {
    movement_.add(TestMotion(30, 1), {annotation({0ms, 300ms}), annotation({0ms, 300ms}), annotation({0ms, 300ms})});
    set({HandMeasure::speed, Side::right}, {1, 2, kNotKnown});
    set({HandMeasure::speed, Side::left}, {3, 0.5f, 0.5f});
    set({HandMeasure::end_height, Side::right}, {0.5f, -1, kNotKnown});
    const auto state = [](Height height, Reach reach, Facing palm, Contact contact, float openness) {
      return static_cast<float>(
          state_number({.openness = openness, .contact = contact, .palm = palm, .fingers = palm}, {height, {}, reach}));
    };
    set({HandMeasure::end_state, Side::right},
        {state(Height::chin, Reach::near, Facing::up, Contact::head | Contact::hands, 0.9f),
         state(Height::shoulder, Reach::far, Facing::unknown, Contact::none, 0), kNotKnown});
    set({HandMeasure::end_x, Side::right}, {0.7f, -0.7f, 0});
    set({HandMeasure::contact, Side::right}, {2, 5, kNotKnown});
    set({HandMeasure::distance, Side::right}, {0.1f, 0.5f, kNotKnown});
  }
  void set(Column column, std::initializer_list<float> values) {
    RowId row = 0;
    for (const float value : values) movement_.at(column, row++) = value;
  }
  /// The rows for which it holds: the first is of both hands, the second of the right, the third of the left.
  std::vector<RowId> rows(const std::string& text) const {
    const Condition parsed = condition(text);
    MovementCheck check(parsed, &movement_);
    const Stretches none = [&]() -> std::vector<TimeSpan> {
      ADD_FAILURE() << text;
      return {};
    };
    std::vector<RowId> result;
    for (RowId row = 0; row < 3; ++row) {
      const Side hand = row == 2 ? Side::left : Side::right;
      if (check.holds({.row = row, .any_hand = row == 0, .hand = hand}, none)) result.push_back(row);
    }
    return result;
  }
  TestMovement movement_;
};

TEST_F(Check, ComparesWhatIsStored) {
  using Rows = std::vector<RowId>;
  EXPECT_EQ(rows("speed(right_hand) > 1 m/s"), (Rows{1}));
  EXPECT_EQ(rows("speed(right_hand) >= 1 m/s"), (Rows{0, 1}));
  EXPECT_EQ(rows("speed(right_hand) < 200 cm/s"), (Rows{0}));
  EXPECT_EQ(rows("speed(right_hand) <= 2 m/s"), (Rows{0, 1}));
  EXPECT_EQ(rows("speed(hand) > 0.4 m/s"), (Rows{0, 1, 2}));
  EXPECT_EQ(rows("speed(hand) > 2.5 m/s"), (Rows{0}));
  EXPECT_EQ(rows("speed(hand) < 1.5 m/s"), (Rows{0, 2}));
  EXPECT_EQ(rows("end(right_hand).height > shoulder"), (Rows{0}));
  EXPECT_EQ(rows("end(right_hand).height >= shoulder"), (Rows{0, 1}));
  EXPECT_EQ(rows("end(right_hand).height != shoulder"), (Rows{0}));
  EXPECT_EQ(rows("end(right_hand).height < -0.5"), (Rows{1}));
  EXPECT_EQ(rows("end(right_hand).x = left"), (Rows{0}));
  EXPECT_EQ(rows("end(right_hand).x != left"), (Rows{1, 2}));
  EXPECT_EQ(rows("end(right_hand).forward = far"), (Rows{1}));
  EXPECT_EQ(rows("end(right_hand).palm = up"), (Rows{0}));
  EXPECT_EQ(rows("end(right_hand).palm != down"), (Rows{0}));
  EXPECT_EQ(rows("end(right_hand).openness > 0.5"), (Rows{0}));
  EXPECT_EQ(rows("end(right_hand).openness < 0.5"), Rows());
  EXPECT_EQ(rows("end(right_hand).contact = hand"), (Rows{0}));
  EXPECT_EQ(rows("contact(right_hand) = head"), (Rows{0}));
  EXPECT_EQ(rows("contact(right_hand) = torso"), (Rows{1}));
  EXPECT_EQ(rows("distance(right_hand, left_hand) < 20 cm"), (Rows{0}));
  EXPECT_EQ(rows("distance(hand, left_hand) < 20 cm"), (Rows{0}));
}

TEST_F(Check, AnotherUnitIsTurnedByTheSignersShoulders) {
  const float width = movement_.shoulder_width(0);
  const auto text = [](const char* what, double value, const char* unit) {
    return fmt::format("{} {:.6f} {}", what, value, unit);
  };
  const std::string high = "end(right_hand).height >";
  EXPECT_EQ(rows(text(high.c_str(), 0.499 * static_cast<double>(width), "m")), (std::vector<RowId>{0}));
  EXPECT_EQ(rows(text(high.c_str(), 0.501 * static_cast<double>(width), "m")), (std::vector<RowId>{}));
  const std::string near = "distance(right_hand, left_hand) <";
  EXPECT_EQ(rows(text(near.c_str(), 0.101 / static_cast<double>(width), "sw")), (std::vector<RowId>{0}));
  EXPECT_EQ(rows(text(near.c_str(), 0.099 / static_cast<double>(width), "sw")), (std::vector<RowId>{}));
}

TEST_F(Check, ANumberThatNoFloatIsIsComparedExactly) {
  set({HandMeasure::speed, Side::right}, {0.1f, std::nextafter(0.1f, 1.0f), std::nextafter(0.1f, 0.0f)});
  // The float next to 0.1 is a little above it.
  EXPECT_EQ(rows("speed(right_hand) > 0.1 m/s"), (std::vector<RowId>{0, 1}));
  EXPECT_EQ(rows("speed(right_hand) >= 0.1 m/s"), (std::vector<RowId>{0, 1}));
  EXPECT_EQ(rows("speed(right_hand) <= 0.1 m/s"), (std::vector<RowId>{2}));
  EXPECT_EQ(rows("speed(right_hand) < 0.1 m/s"), (std::vector<RowId>{2}));
}

TEST(Movement, WithoutMovementNothingHolds) {
  const Condition parsed = condition("speed(right_hand) < 1000 m/s");
  EXPECT_FALSE(MovementCheck(parsed, nullptr).holds({.row = 0}, {}));
}

/// Some rows of two recordings that move by chance, and the stretches of each.
struct Rows {
  std::vector<MovementRow> rows;
  std::vector<std::vector<TimeSpan>> stretches;
};
Rows some_rows(std::mt19937& random) {
  Rows result;
  const auto time = [&](unsigned least) { return Milliseconds(least + random() % 1'200); };
  for (int i = 0; i < 12; ++i) {
    const Milliseconds begin = time(0);
    const TimeSpan span{begin, begin + time(1)};
    if (random() % 2 == 0) {
      result.rows.push_back(annotation(span));
      result.stretches.push_back({span});
      continue;
    }
    const auto parent = static_cast<RowId>(result.rows.size());
    const Milliseconds middle = span.begin + span.duration() / 2;
    result.rows.push_back(sign(span));
    result.rows.push_back(phase(PhaseKind::stroke, parent, {span.begin, middle}));
    result.rows.push_back(phase(random() % 2 == 0 ? PhaseKind::stroke : PhaseKind::hold, parent, {middle, span.end}));
    result.stretches.push_back({result.rows[parent + 1].span});
    if (result.rows.back().phase == PhaseKind::stroke) result.stretches.back().push_back(result.rows.back().span);
    result.stretches.push_back({result.rows[parent + 1].span});
    result.stretches.push_back({result.rows[parent + 2].span});
  }
  return result;
}

RC_GTEST_PROP(Movement, WhatIsStoredWhatIsComputedAndWhatIsScannedAgree, (std::uint32_t seed)) {
  std::mt19937 random(seed);
  const Rows rows = some_rows(random);
  TestMovement stored(TestMovement::From::columns);
  TestMovement computed(TestMovement::From::frames);
  stored.add(TestMotion(90, seed), rows.rows);
  computed.add(TestMotion(90, seed), rows.rows);
  RandomQueries queries(random, true);
  for (int i = 0; i < 60; ++i) {
    const Condition condition = queries.moving().condition;
    RC_LOG() << to_string(condition) << '\n';
    MovementCheck from_columns(condition, &stored);
    MovementCheck from_frames(condition, &computed);
    std::vector<RowId> found;
    for (RowId row = 0; row < rows.rows.size(); ++row) {
      const unsigned hand = random() % 3;
      const MovingRow moving{.row = row, .any_hand = hand == 2, .hand = static_cast<Side>(hand % 2)};
      const Stretches stretches = [&] { return rows.stretches[row]; };
      const bool holds = from_columns.holds(moving, stretches);
      RC_ASSERT(holds == from_frames.holds(moving, stretches));
      if (holds) found.push_back(row);
    }
    std::vector<RowId> scanned;
    if (!from_columns.scan(0, 0, scanned)) continue;
    RC_ASSERT(std::is_sorted(scanned.begin(), scanned.end()));
    RC_ASSERT(std::includes(scanned.begin(), scanned.end(), found.begin(), found.end()));
    const MovementTerm& term = condition.movement;
    const bool own = term.point.kind == Point::Kind::hand || (term.other && term.other->kind == Point::Kind::hand);
    if (!own) RC_ASSERT(scanned == found);
  }
}

}  // namespace
}  // namespace signweave
