#include "signweave/query/movement.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace signweave {
namespace {

constexpr float kOpenness = 127;

/// Measures of one span of a row.
struct SpanMeasures {
  std::array<std::optional<Course>, 2> hands;  ///< [Side]; nullopt: not known
  double frames = 0;                           ///< its weight in a mean
  Distances apart;                             ///< distances of the palms
  TwoHandedSum both;                           ///< empty unless both hands are known
};

PointFrame point_of(const HandAt& at) noexcept {
  return {.position = at.position,
          .velocity = at.velocity,
          .acceleration = at.acceleration.norm(),
          .state = {.openness = at.openness,
                    .contact = at.contact,
                    .palm = facing_of(at.palm),
                    .fingers = facing_of(at.fingers)}};
}

bool is_finite(const PointOver& over) noexcept {
  return std::isfinite(over.path_length) && std::isfinite(over.mean_acceleration) && over.begin.position.allFinite() &&
         over.end.position.allFinite();
}

SpanMeasures from_trace(const HandTrace& trace, FrameRange frames, const Pause& pause) {
  SpanMeasures result;
  if (frames.empty() || trace.samples() == 0) return result;
  result.frames = static_cast<double>(frames.size());
  std::array<PointTrack, 2> tracks;
  std::array<CourseSum, 2> sums = {CourseSum(trace.body), CourseSum(trace.body)};
  bool apart = true;
  for_pieces(frames, pause, [&](FrameRange piece) {
    for (const Side side : kSides) {
      const auto i = static_cast<std::size_t>(side);
      trace.track(palm_on(side), piece, tracks[i]);
      for (const PointFrame& frame : tracks[i]) sums[i].add(frame);
    }
    apart = apart && result.apart.add(tracks[0], tracks[1], trace.shoulder_width);
    result.both.add(tracks[0], tracks[1]);
  });
  for (std::size_t i = 0; i < 2; ++i) {
    if (tracks[i].empty()) continue;
    const Course measured = sums[i].course(trace.rate, trace.shoulder_width);
    if (is_finite(measured.over)) result.hands[i] = measured;
  }
  if (result.hands[0] && result.hands[1]) return result;
  result.apart = {};
  result.both = {};
  return result;
}

/// The measures from the features; those that features lack from the trace.
SpanMeasures from_features(const PhaseFeatures& phase, const SpanMeasures& traced, const SignerBody& body) {
  SpanMeasures result;
  result.frames = traced.frames;
  for (std::size_t side = 0; side < 2; ++side) {
    const HandOver& hand = phase.hands[side];
    if (!hand.known) continue;
    ExtentSum reached(body);
    if (traced.hands[side]) reached.start_from(traced.hands[side]->extent);
    PointOver& over = result.hands[side].emplace().over;
    over.peak_speed = hand.peak_speed;
    over.mean_speed = hand.mean_speed;
    over.mean_acceleration = hand.mean_acceleration;
    over.path_length = hand.path_length;
    over.displacement = hand.displacement;
    over.begin = point_of(hand.begin);
    over.end = point_of(hand.end);
    over.contact = hand.begin.contact | hand.end.contact;
    over.peak_acceleration = std::max(over.begin.acceleration, over.end.acceleration);
    reached.include(over.begin);
    reached.include(over.end);
    result.hands[side]->extent = reached.extent();
    if (!traced.hands[side]) continue;
    over.contact = over.contact | traced.hands[side]->over.contact;
    over.peak_acceleration = std::max(over.peak_acceleration, traced.hands[side]->over.peak_acceleration);
  }
  if (!result.hands[0] || !result.hands[1]) return result;
  result.both = traced.both;
  const auto [begin, end] = std::pair(phase.hands_distance_begin, phase.hands_distance_end);
  result.apart = {.least = std::min({traced.apart.least, begin, end}),
                  .most = std::max({traced.apart.most, begin, end}),
                  .begin = begin,
                  .end = end};
  return result;
}

/// Joins consecutive spans; a value that is not known for one is not known for the whole.
SpanMeasures joined(std::span<const SpanMeasures> spans, float shoulder_width) {
  if (spans.empty()) return {};
  SpanMeasures result;
  result.apart = spans.front().apart;
  for (const SpanMeasures& each : spans) {
    result.frames += each.frames;
    result.apart.least = std::min(result.apart.least, each.apart.least);
    result.apart.most = std::max(result.apart.most, each.apart.most);
    result.both += each.both;
  }
  result.apart.end = spans.back().apart.end;
  if (!std::ranges::all_of(spans, [](const SpanMeasures& each) { return each.apart.known(); })) result.apart = {};
  if (std::ranges::any_of(spans, [](const SpanMeasures& each) { return each.both.empty(); })) result.both = {};
  for (std::size_t side = 0; side < 2; ++side) {
    std::vector<Course> courses;
    std::vector<double> weights;
    for (const SpanMeasures& each : spans) {
      if (!each.hands[side]) break;
      courses.push_back(*each.hands[side]);
      weights.push_back(each.frames);
    }
    if (courses.size() == spans.size()) result.hands[side] = join(courses, weights, shoulder_width);
  }
  return result;
}

void write(const SpanMeasures& measures, const SignerBody& body, std::size_t row, MovementColumns& columns) {
  const auto put = [&](HandMeasure measure, Side side, float value) {
    columns[place_of({measure, side})][row] = value;
  };
  for (const Side side : kSides) {
    const std::optional<Course>& hand = measures.hands[static_cast<std::size_t>(side)];
    if (!hand) continue;
    for (std::size_t i = 0; i < kHandMeasures; ++i) {
      const auto measure = static_cast<HandMeasure>(i);
      put(measure, side, measure_of(*hand, measure, body));
    }
  }
  for (const HandMeasure measure :
       {HandMeasure::distance, HandMeasure::most_distance, HandMeasure::begin_distance, HandMeasure::end_distance}) {
    put(measure, Side::left, measures.apart[measure]);
  }
  put(HandMeasure::hands, Side::left, hands_of(measures.both, body));
}

}  // namespace

std::uint32_t state_number(const HandState& state, Zone zone) noexcept {
  const auto openness = static_cast<std::uint32_t>(std::lround(std::clamp(state.openness, 0.0f, 1.0f) * kOpenness));
  return openness | static_cast<std::uint32_t>(state.contact) << 7U | static_cast<std::uint32_t>(state.palm) << 10U |
         static_cast<std::uint32_t>(state.fingers) << 13U | static_cast<std::uint32_t>(zone.height) << 16U |
         static_cast<std::uint32_t>(zone.reach) << 19U;
}

StateAndZone state_of(std::uint32_t number) noexcept {
  return {.state = {.openness = static_cast<float>(number & 127U) / kOpenness,
                    .contact = static_cast<Contact>(number >> 7U & 7U),
                    .palm = static_cast<Facing>(number >> 10U & 7U),
                    .fingers = static_cast<Facing>(number >> 13U & 7U)},
          .height = static_cast<Height>(number >> 16U & 7U),
          .reach = static_cast<Reach>(number >> 19U & 1U)};
}

float hands_of(const TwoHandedSum& both, const SignerBody& body) noexcept {
  if (both.empty()) return kNotKnown;
  const std::optional<Hands> hands = class_of(both.movement(), body);
  return hands ? static_cast<float>(bit_of(*hands)) : kNotKnown;
}

float measure_of(const Course& course, HandMeasure measure, const SignerBody& body) noexcept {
  const PointOver& over = course.over;
  const Extent& extent = course.extent;
  const auto state = [&](const PointFrame& at) {
    return static_cast<float>(state_number(at.state, zone_of(at.position, body)));
  };
  switch (measure) {
    case HandMeasure::speed:
      return over.peak_speed;
    case HandMeasure::mean_speed:
      return over.mean_speed;
    case HandMeasure::least_speed:
      return extent.speed.least;
    case HandMeasure::acceleration:
      return over.peak_acceleration;
    case HandMeasure::mean_acceleration:
      return over.mean_acceleration;
    case HandMeasure::least_acceleration:
      return extent.acceleration.least;
    case HandMeasure::path:
      return over.path_length;
    case HandMeasure::displacement:
      return over.displacement;
    case HandMeasure::contact:
      return static_cast<float>(over.contact);
    case HandMeasure::begin_x:
      return over.begin.position.x();
    case HandMeasure::begin_height:
      return over.begin.position.y();
    case HandMeasure::begin_forward:
      return over.begin.position.z();
    case HandMeasure::begin_state:
      return state(over.begin);
    case HandMeasure::end_x:
      return over.end.position.x();
    case HandMeasure::end_height:
      return over.end.position.y();
    case HandMeasure::end_forward:
      return over.end.position.z();
    case HandMeasure::end_state:
      return state(over.end);
    case HandMeasure::least_x:
      return extent.x.least;
    case HandMeasure::least_height:
      return extent.height.least;
    case HandMeasure::least_forward:
      return extent.forward.least;
    case HandMeasure::least_openness:
      return extent.openness.empty() ? kNotKnown : extent.openness.least;
    case HandMeasure::most_x:
      return extent.x.most;
    case HandMeasure::most_height:
      return extent.height.most;
    case HandMeasure::most_forward:
      return extent.forward.most;
    case HandMeasure::most_openness:
      return extent.openness.empty() ? kNotKnown : extent.openness.most;
    case HandMeasure::zones:
      return static_cast<float>(extent.in);
    case HandMeasure::entered:
      return static_cast<float>(extent.into);
    case HandMeasure::facings:
      return static_cast<float>(extent.faces);
    case HandMeasure::distance:
    case HandMeasure::most_distance:
    case HandMeasure::begin_distance:
    case HandMeasure::end_distance:
    case HandMeasure::hands:
      break;
  }
  return kNotKnown;
}

FrameRange measured_frames(TimeSpan span, const FrameClock& clock, std::int64_t frames) noexcept {
  const FrameRange asked = frames_of(span, clock);
  if (asked.empty() && 0 <= asked.begin && asked.begin < frames) return {asked.begin, asked.begin + 1};
  return clamp(asked, frames);
}

bool Distances::add(std::span<const PointFrame> a, std::span<const PointFrame> b, float shoulder_width) noexcept {
  const bool first = !known();
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    end = (a[i].position - b[i].position).norm() * shoulder_width;
    if (std::isnan(end)) {
      *this = {};
      return false;
    }
    if (first && i == 0) least = most = begin = end;
    least = std::min(least, end);
    most = std::max(most, end);
  }
  return known();
}

float Distances::operator[](HandMeasure measure) const noexcept {
  switch (measure) {
    case HandMeasure::distance:
      return least;
    case HandMeasure::most_distance:
      return most;
    case HandMeasure::begin_distance:
      return begin;
    case HandMeasure::end_distance:
      return end;
    default:
      return kNotKnown;
  }
}

Course join(std::span<const Course> courses, std::span<const double> frames, float shoulder_width) noexcept {
  Course result = courses.front();
  if (courses.size() == 1) return result;
  PointOver& all = result.over;
  all.end = courses.back().over.end;
  double weight = 0;
  double path = 0;
  double speeds = 0;
  double accelerations = 0;
  for (std::size_t i = 0; i < courses.size(); ++i) {
    const PointOver& over = courses[i].over;
    const double share = std::max(frames[i], 1.0);
    weight += share;
    path += static_cast<double>(over.path_length);
    speeds += share * static_cast<double>(over.mean_speed);
    accelerations += share * static_cast<double>(over.mean_acceleration);
    all.peak_speed = std::max(all.peak_speed, over.peak_speed);
    all.peak_acceleration = std::max(all.peak_acceleration, over.peak_acceleration);
    all.contact = all.contact | over.contact;
    result.extent = join(result.extent, courses[i].extent);
  }
  all.path_length = static_cast<float>(path);
  all.mean_speed = static_cast<float>(speeds / weight);
  all.mean_acceleration = static_cast<float>(accelerations / weight);
  all.displacement = (all.end.position - all.begin.position).norm() * shoulder_width;
  return result;
}

MovementColumns measure_rows(std::span<const MovementRow> rows, const RecordingFeatures& features,
                             const HandTrace& trace, const FrameClock& clock, const Pause& pause) {
  MovementColumns columns;
  for (std::vector<float>& column : columns) column.assign(rows.size(), kNotKnown);
  struct Stroke {
    Milliseconds begin;
    SpanMeasures measures;
  };
  std::vector<std::vector<Stroke>> strokes(rows.size());
  std::size_t phase = 0;
  std::size_t calls = 0;
  const Pause pauses = [&] {  // most rows are short
    if (pause && (calls++ & 0xFU) == 0) pause();
  };
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (rows[row].kind == RowKind::sign) continue;
    const SpanMeasures traced = from_trace(trace, measured_frames(rows[row].span, clock, trace.frames), pauses);
    if (rows[row].kind == RowKind::annotation) {
      write(traced, trace.body, row, columns);
      continue;
    }
    const std::size_t place = phase++;
    const bool measured = place < features.phases.size() && features.phases[place].known;
    const SpanMeasures measures = measured ? from_features(features.phases[place], traced, trace.body) : traced;
    write(measures, trace.body, row, columns);
    if (rows[row].phase == PhaseKind::stroke && rows[row].parent < rows.size()) {
      strokes[rows[row].parent].push_back({rows[row].span.begin, measures});
    }
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (rows[row].kind != RowKind::sign) continue;
    pauses();
    std::ranges::stable_sort(strokes[row], {}, &Stroke::begin);
    std::vector<SpanMeasures> spans;
    for (const Stroke& stroke : strokes[row]) spans.push_back(stroke.measures);
    write(joined(spans, trace.shoulder_width), trace.body, row, columns);
  }
  return columns;
}

}  // namespace signweave
