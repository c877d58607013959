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

TEST(Movement, EveryColumnHasItsOwnIndex) {
  std::set<std::size_t> places;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(HandMeasure::hands); ++i) {
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

TEST(Movement, AShortRowHasOneFrameAndOneOutsideTheMotionNone) {
  const FrameClock clock{.frame_time = Seconds(0.1)};
  EXPECT_EQ(measured_frames({200ms, 500ms}, clock, 10), (FrameRange{2, 5}));
  EXPECT_EQ(measured_frames({200ms, 210ms}, clock, 10), (FrameRange{2, 3}));
  EXPECT_EQ(measured_frames({800ms, 2'000ms}, clock, 10), (FrameRange{8, 10}));
  EXPECT_TRUE(measured_frames({1'800ms, 2'000ms}, clock, 10).empty());
}

TEST(Movement, PhasesUseFeaturesSignsTheirStrokesAndOthersTheTrace) {
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

TEST(Movement, BothHandsAreClassifiedOverAllStrokesOfASign) {
  const std::vector<MovementRow> rows = {sign({500ms, 2'000ms}), phase(PhaseKind::stroke, 0, {800ms, 1'200ms}),
                                         phase(PhaseKind::hold, 0, {1'200ms, 1'500ms}),
                                         phase(PhaseKind::stroke, 0, {1'500ms, 2'000ms})};
  std::set<float> classes;
  for (unsigned seed = 1; seed < 12; ++seed) {
    const TestMotion test(150, seed);
    const HandTrace trace = trace_hands(test.motion, test.model);
    const std::vector<TimeSpan> spans = {rows[1].span, rows[2].span, rows[3].span};
    const RecordingFeatures features = measure_phases(test.motion, test.model, spans, test.clock);
    const auto class_over = [&](std::initializer_list<FrameRange> strokes) {
      TwoHandedSum sum;
      for (const FrameRange frames : strokes) {
        sum.add(trace.track(TracePoint::left_palm, frames), trace.track(TracePoint::right_palm, frames));
      }
      return hands_of(sum, trace.body);
    };
    for (const RecordingFeatures& stored : {features, RecordingFeatures()}) {
      const MovementColumns columns = measure_rows(rows, stored, trace, test.clock);
      const std::vector<float>& hands = columns[place_of({HandMeasure::hands, Side::left})];
      EXPECT_EQ(hands[0], class_over({{48, 72}, {90, 120}})) << seed;
      EXPECT_EQ(hands[3], class_over({{90, 120}})) << seed;
      classes.insert({hands[0], hands[3]});
    }
  }
  EXPECT_GE(classes.size(), 2U);
}

TEST(Movement, TheExtentIsThatOfTheFrames) {
  const TestMotion test(240, 11);
  const HandTrace trace = trace_hands(test.motion, test.model);
  const std::vector<MovementRow> rows = {annotation({500ms, 2'500ms})};
  const MovementColumns columns = measure_rows(rows, {}, trace, test.clock);
  const auto at = [&](HandMeasure measure) { return columns[place_of({measure, Side::left})][0]; };
  const PointTrack left = trace.track(TracePoint::left_palm, {30, 150});
  const PointTrack right = trace.track(TracePoint::right_palm, {30, 150});
  const auto number = [&](const auto& of, bool most) {
    std::vector<float> numbers;
    for (const PointFrame& frame : left) numbers.push_back(of(frame));
    return most ? *std::ranges::max_element(numbers) : *std::ranges::min_element(numbers);
  };
  const auto height = [](const PointFrame& frame) { return frame.position.y(); };
  EXPECT_EQ(at(HandMeasure::most_height), number(height, true));
  EXPECT_EQ(at(HandMeasure::least_height), number(height, false));
  const auto x = [](const PointFrame& frame) { return frame.position.x(); };
  EXPECT_EQ(at(HandMeasure::most_x), number(x, true));
  EXPECT_EQ(at(HandMeasure::least_x), number(x, false));
  const auto forward = [](const PointFrame& frame) { return frame.position.z(); };
  EXPECT_EQ(at(HandMeasure::most_forward), number(forward, true));
  EXPECT_EQ(at(HandMeasure::least_forward), number(forward, false));
  const auto openness = [](const PointFrame& frame) { return frame.state.openness; };
  EXPECT_EQ(at(HandMeasure::most_openness), number(openness, true));
  EXPECT_EQ(at(HandMeasure::least_openness), number(openness, false));
  EXPECT_EQ(at(HandMeasure::least_speed), number([](const PointFrame& frame) { return frame.velocity.norm(); }, false));
  EXPECT_EQ(at(HandMeasure::least_acceleration),
            number([](const PointFrame& frame) { return frame.acceleration; }, false));
  EXPECT_GT(at(HandMeasure::most_height), at(HandMeasure::least_height));

  std::uint32_t in = 0;
  std::uint32_t into = 0;
  std::uint32_t faces = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const Zone zone = zone_of(left[i].position, trace.body);
    in |= bits_of(zone);
    faces |= palm_bit(left[i].state.palm) | fingers_bit(left[i].state.fingers);
    if (i == 0) continue;
    const Zone before = zone_of(left[i - 1].position, trace.body);
    if (zone.height != before.height) into |= bit_of(zone.height);
    if (zone.across != before.across) into |= bit_of(zone.across);
    if (zone.reach != before.reach) into |= bit_of(zone.reach);
  }
  EXPECT_EQ(at(HandMeasure::zones), static_cast<float>(in));
  EXPECT_EQ(at(HandMeasure::entered), static_cast<float>(into));
  EXPECT_EQ(at(HandMeasure::facings), static_cast<float>(faces));
  EXPECT_NE(into, 0U);

  float most = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    most = std::max(most, (left[i].position - right[i].position).norm() * trace.shoulder_width);
  }
  EXPECT_EQ(at(HandMeasure::most_distance), most);
  EXPECT_LT(at(HandMeasure::distance), most);
}

TEST(Movement, AZoneIsEnteredFromOutsideOnly) {
  SignerBody body;
  for (std::size_t i = 0; i < body.heights.size(); ++i) body.heights[i] = static_cast<float>(i);
  const auto at = [](float height) { return PointFrame{.position = {0, height, 0}}; };
  ExtentSum sum(body);
  for (const float height : {3.5f, 3.5f, 4.5f, 4.6f}) sum.add(at(height));
  EXPECT_EQ(sum.extent().in & kHeightBits, bit_of(Height::shoulder) | bit_of(Height::chin));
  EXPECT_EQ(sum.extent().into, bit_of(Height::chin)) << "it was at the shoulder from the start";
  sum.add(at(3.5f));
  EXPECT_EQ(sum.extent().into, bit_of(Height::shoulder) | bit_of(Height::chin)) << "it left and came back";
  sum.include(at(1.5f));
  EXPECT_EQ(sum.extent().into, bit_of(Height::shoulder) | bit_of(Height::chin)) << "a frame by itself enters nothing";
  EXPECT_EQ(sum.extent().height.least, 1.5f);
}

TEST(Movement, AHandWithoutFingersHasNoOpennessAndNoDirection) {
  const SignerBody body;
  ExtentSum sum(body);
  sum.add({.state = {.openness = 0, .palm = Facing::unknown}});
  const Course course{.over = {}, .extent = sum.extent()};
  EXPECT_TRUE(std::isnan(measure_of(course, HandMeasure::most_openness, body)));
  EXPECT_TRUE(std::isnan(measure_of(course, HandMeasure::least_openness, body)));
  EXPECT_EQ(measure_of(course, HandMeasure::facings, body), 0);
}

TEST(Movement, SeveralSpansAreJoinedByPeaksSumsAndMeans) {
  std::array<Course, 2> courses;
  courses[0].over.peak_speed = 1;
  courses[1].over.peak_speed = 3;
  courses[0].over.mean_speed = 1;
  courses[1].over.mean_speed = 2;
  courses[0].over.path_length = 0.1f;
  courses[1].over.path_length = 0.2f;
  courses[1].over.end.position = {1, 0, 0};
  courses[0].extent.height.add(-1);
  courses[1].extent.height.add(2);
  courses[0].extent.in = bit_of(Height::waist);
  courses[1].extent.in = bit_of(Height::chin);
  const std::array<double, 2> frames = {10, 30};
  const Course all = join(courses, frames, 0.4f);
  EXPECT_EQ(all.over.peak_speed, 3);
  EXPECT_FLOAT_EQ(all.over.mean_speed, 1.75f);
  EXPECT_FLOAT_EQ(all.over.path_length, 0.3f);
  EXPECT_FLOAT_EQ(all.over.displacement, 0.4f);
  EXPECT_EQ(all.extent.height.least, -1);
  EXPECT_EQ(all.extent.height.most, 2);
  EXPECT_EQ(all.extent.in, bit_of(Height::waist) | bit_of(Height::chin));
  EXPECT_EQ(all.extent.into, 0) << "the frames between two spans are not examined";
}

TEST(Movement, RowsOutsideTheMotionAndSignsWithoutStrokeAreNotKnown) {
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
  EXPECT_TRUE(std::isnan(columns[place_of({HandMeasure::hands, Side::right})][0]));
}

Condition condition(const std::string& text) {
  return parse(text).elements.front().term.expression.condition;
}

/// Three rows of three hands with chosen values.
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
    set({HandMeasure::most_distance, Side::right}, {0.2f, 0.9f, kNotKnown});
    const SignerBody body = movement_.hands(0)->body;
    chin_ = body.heights[static_cast<std::size_t>(Height::chin)];
    set({HandMeasure::most_height, Side::right}, {chin_, std::nextafter(chin_, -9.0f), kNotKnown});
    set({HandMeasure::least_height, Side::right}, {-1, -2, kNotKnown});
    set({HandMeasure::most_x, Side::right}, {kCentre, std::nextafter(kCentre, 9.0f), kNotKnown});
    set({HandMeasure::least_speed, Side::right}, {0.1f, 0.2f, kNotKnown});
    const auto bits = [](auto... each) { return static_cast<float>((bit_of(each) | ...)); };
    set({HandMeasure::zones, Side::right}, {bits(Height::chin, Height::shoulder, Across::centre, Reach::near),
                                            bits(Height::shoulder, Across::left, Reach::far), kNotKnown});
    set({HandMeasure::entered, Side::right}, {bits(Height::chin), 0, kNotKnown});
    set({HandMeasure::facings, Side::right},
        {static_cast<float>(palm_bit(Facing::up) | fingers_bit(Facing::left)), 0, kNotKnown});
  }
  void set(Column column, std::initializer_list<float> values) {
    RowId row = 0;
    for (const float value : values) movement_.at(column, row++) = value;
  }
  /// The rows for which it holds: the first has both hands, the second the right, the third the left.
  std::vector<RowId> rows(const std::string& text) const {
    const Condition parsed = condition(text);
    MovementCheck check(parsed, &movement_);
    const MeasuredSpans none = [&]() -> std::vector<TimeSpan> {
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
  float chin_ = 0;  ///< where its zone begins
};

TEST_F(Check, ComparesExtents) {
  using Rows = std::vector<RowId>;
  EXPECT_EQ(rows("max(right_hand).height >= chin"), (Rows{0}));
  EXPECT_EQ(rows("max(right_hand).height > shoulder"), (Rows{0}));
  EXPECT_EQ(rows("max(right_hand).height = chin"), (Rows{0}));
  EXPECT_EQ(rows("max(right_hand).height != chin"), (Rows{1}));
  EXPECT_EQ(rows("max(right_hand).height < chin"), (Rows{1}));
  EXPECT_EQ(rows("max(right_hand).height <= chin"), (Rows{0, 1}));
  EXPECT_EQ(rows("max(right_hand).height > chin"), Rows());
  EXPECT_EQ(rows("max(right_hand).height < 100"), (Rows{0, 1}));
  EXPECT_EQ(rows("max(right_hand).x = centre"), (Rows{0}));
  EXPECT_EQ(rows("max(right_hand).x = left"), (Rows{1}));
  EXPECT_EQ(rows("max(right_hand).x != left"), (Rows{0}));
  EXPECT_EQ(rows("min(right_hand).height < -1.5"), (Rows{1}));
  EXPECT_EQ(rows("any(right_hand).height > shoulder"), (Rows{0})) << "where the maximum is";
  EXPECT_EQ(rows("any(right_hand).height < -1.5"), (Rows{1})) << "where the minimum is";
  EXPECT_EQ(rows("any(right_hand).height = chin"), (Rows{0}));
  EXPECT_EQ(rows("any(right_hand).height = shoulder"), (Rows{0, 1}));
  EXPECT_EQ(rows("any(right_hand).height != shoulder"), (Rows{0})) << "at some moment elsewhere";
  EXPECT_EQ(rows("any(right_hand).x = left"), (Rows{1}));
  EXPECT_EQ(rows("any(right_hand).forward = far"), (Rows{1}));
  EXPECT_EQ(rows("any(right_hand).palm = up"), (Rows{0}));
  EXPECT_EQ(rows("any(right_hand).palm != up"), Rows()) << "a hand without fingers has no palm that is not up either";
  EXPECT_EQ(rows("any(right_hand).fingers != up"), (Rows{0}));
  EXPECT_EQ(rows("any(right_hand).contact = head"), (Rows{0}));
  EXPECT_EQ(rows("enters(right_hand, chin)"), (Rows{0}));
  EXPECT_EQ(rows("enters(right_hand).height = shoulder"), Rows());
  EXPECT_EQ(rows("min(speed(right_hand)) > 0.15 m/s"), (Rows{1}));
  EXPECT_EQ(rows("any(speed(right_hand)) < 0.15 m/s"), (Rows{0}));
  EXPECT_EQ(rows("any(speed(right_hand)) > 1.5 m/s"), (Rows{1}));
  EXPECT_EQ(rows("max(distance(right_hand, left_hand)) < 50 cm"), (Rows{0}));
  EXPECT_EQ(rows("min(distance(right_hand, left_hand)) < 50 cm"), (Rows{0}));
}

TEST_F(Check, ComparesStoredColumns) {
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

TEST_F(Check, AnotherUnitIsConvertedByTheShoulderWidth) {
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

TEST_F(Check, ANumberThatIsNotAFloatIsComparedExactly) {
  set({HandMeasure::speed, Side::right}, {0.1f, std::nextafter(0.1f, 1.0f), std::nextafter(0.1f, 0.0f)});
  // The float next to 0.1 is slightly above it.
  EXPECT_EQ(rows("speed(right_hand) > 0.1 m/s"), (std::vector<RowId>{0, 1}));
  EXPECT_EQ(rows("speed(right_hand) >= 0.1 m/s"), (std::vector<RowId>{0, 1}));
  EXPECT_EQ(rows("speed(right_hand) <= 0.1 m/s"), (std::vector<RowId>{2}));
  EXPECT_EQ(rows("speed(right_hand) < 0.1 m/s"), (std::vector<RowId>{2}));
}

TEST(Movement, WithoutMovementNothingHolds) {
  const Condition parsed = condition("speed(right_hand) < 1000 m/s");
  EXPECT_FALSE(MovementCheck(parsed, nullptr).holds({.row = 0}, {}));
}

/// Some rows of two recordings with random movement, and the spans of each.
struct Rows {
  std::vector<MovementRow> rows;
  std::vector<std::vector<TimeSpan>> spans;
};
Rows some_rows(std::mt19937& random) {
  Rows result;
  const auto time = [&](unsigned least) { return Milliseconds(least + random() % 1'200); };
  for (int i = 0; i < 12; ++i) {
    const Milliseconds begin = time(0);
    const TimeSpan span{begin, begin + time(1)};
    if (random() % 2 == 0) {
      result.rows.push_back(annotation(span));
      result.spans.push_back({span});
      continue;
    }
    const auto parent = static_cast<RowId>(result.rows.size());
    const Milliseconds middle = span.begin + span.duration() / 2;
    result.rows.push_back(sign(span));
    result.rows.push_back(phase(PhaseKind::stroke, parent, {span.begin, middle}));
    result.rows.push_back(phase(random() % 2 == 0 ? PhaseKind::stroke : PhaseKind::hold, parent, {middle, span.end}));
    result.spans.push_back({result.rows[parent + 1].span});
    if (result.rows.back().phase == PhaseKind::stroke) result.spans.back().push_back(result.rows.back().span);
    result.spans.push_back({result.rows[parent + 1].span});
    result.spans.push_back({result.rows[parent + 2].span});
  }
  return result;
}

RC_GTEST_PROP(Movement, StoredComputedAndScannedValuesAgree, (std::uint32_t seed)) {
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
      const MeasuredSpans spans = [&] { return rows.spans[row]; };
      const bool holds = from_columns.holds(moving, spans);
      RC_ASSERT(holds == from_frames.holds(moving, spans));
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
