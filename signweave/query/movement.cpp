#include "signweave/query/movement.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "signweave/features/point_sum.h"

namespace signweave {
namespace {

constexpr float kOpenness = 127;

/// What is measured of one stretch of a row.
struct Stretch {
  std::array<std::optional<PointOver>, 2> hands;  ///< [Side]; none: not known
  double frames = 0;                              ///< its weight in a mean
  float distance = kNotKnown;                     ///< of the palms, the least, metres
  float begin_distance = kNotKnown;
  float end_distance = kNotKnown;
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

/// The least of two, or what is no number.
float lesser(float a, float b) noexcept {
  return std::isnan(a) || std::isnan(b) ? kNotKnown : std::min(a, b);
}

bool is_finite(const PointOver& over) noexcept {
  return std::isfinite(over.path_length) && std::isfinite(over.mean_acceleration) && over.begin.position.allFinite() &&
         over.end.position.allFinite();
}

Stretch from_trace(const HandTrace& trace, FrameRange frames, const Pause& pause) {
  Stretch result;
  if (frames.empty() || trace.samples() == 0) return result;
  result.frames = static_cast<double>(frames.size());
  std::array<PointTrack, 2> tracks;
  std::array<PointSum, 2> sums;
  const auto apart = [&](const PointFrame& a, const PointFrame& b) {
    return (a.position - b.position).norm() * trace.shoulder_width;
  };
  float least = std::numeric_limits<float>::infinity();
  for_pieces(frames, pause, [&](FrameRange piece) {
    for (const Side side : kSides) {
      const auto i = static_cast<std::size_t>(side);
      trace.track(palm_on(side), piece, tracks[i]);
      for (const PointFrame& frame : tracks[i]) sums[i].add(frame);
    }
    if (tracks[0].empty() || tracks[1].empty()) return;
    least = lesser(least, least_distance(tracks[0], tracks[1], trace.shoulder_width));
    if (piece.begin == frames.begin) result.begin_distance = apart(tracks[0].front(), tracks[1].front());
    result.end_distance = apart(tracks[0].back(), tracks[1].back());
  });
  for (std::size_t i = 0; i < 2; ++i) {
    if (tracks[i].empty()) continue;
    const PointOver measured = sums[i].over(trace.rate, trace.shoulder_width);
    if (is_finite(measured)) result.hands[i] = measured;
  }
  if (result.hands[0] && result.hands[1]) {
    result.distance = least;
  } else {
    result.begin_distance = result.end_distance = kNotKnown;
  }
  return result;
}

/// The features, and what they lack from the trace.
Stretch from_features(const PhaseFeatures& phase, const Stretch& traced) {
  Stretch result;
  result.frames = traced.frames;
  for (std::size_t side = 0; side < 2; ++side) {
    const HandOver& hand = phase.hands[side];
    if (!hand.known) continue;
    PointOver& over = result.hands[side].emplace();
    over.peak_speed = hand.peak_speed;
    over.mean_speed = hand.mean_speed;
    over.mean_acceleration = hand.mean_acceleration;
    over.path_length = hand.path_length;
    over.displacement = hand.displacement;
    over.begin = point_of(hand.begin);
    over.end = point_of(hand.end);
    over.contact = hand.begin.contact | hand.end.contact;
    over.peak_acceleration = std::max(hand.begin.acceleration.norm(), hand.end.acceleration.norm());
    if (!traced.hands[side]) continue;
    over.contact = over.contact | traced.hands[side]->contact;
    over.peak_acceleration = std::max(over.peak_acceleration, traced.hands[side]->peak_acceleration);
  }
  if (!result.hands[0] || !result.hands[1]) return result;
  result.begin_distance = phase.hands_distance_begin;
  result.end_distance = phase.hands_distance_end;
  result.distance = std::min({traced.distance, result.begin_distance, result.end_distance});
  return result;
}

/// Of several one after the other; what is not known of one is not known of all.
Stretch joined(std::span<const Stretch> stretches, float shoulder_width) {
  if (stretches.empty()) return {};
  Stretch result;
  result.distance = std::numeric_limits<float>::infinity();
  result.begin_distance = stretches.front().begin_distance;
  result.end_distance = stretches.back().end_distance;
  for (const Stretch& each : stretches) {
    result.frames += each.frames;
    result.distance = std::min(result.distance, each.distance);
    if (!std::isnan(each.distance)) continue;
    result.distance = result.begin_distance = result.end_distance = kNotKnown;
    break;
  }
  for (std::size_t side = 0; side < 2; ++side) {
    std::vector<PointOver> overs;
    std::vector<double> weights;
    for (const Stretch& each : stretches) {
      if (!each.hands[side]) break;
      overs.push_back(*each.hands[side]);
      weights.push_back(each.frames);
    }
    if (overs.size() == stretches.size()) result.hands[side] = join(overs, weights, shoulder_width);
  }
  return result;
}

void write(const Stretch& stretch, const SignerBody& body, std::size_t row, MovementColumns& columns) {
  const auto put = [&](HandMeasure measure, Side side, float value) {
    columns[place_of({measure, side})][row] = value;
  };
  for (const Side side : kSides) {
    const std::optional<PointOver>& hand = stretch.hands[static_cast<std::size_t>(side)];
    if (!hand) continue;
    for (std::size_t i = 0; i < kHandMeasures; ++i) {
      const auto measure = static_cast<HandMeasure>(i);
      put(measure, side, measure_of(*hand, measure, body));
    }
  }
  put(HandMeasure::distance, Side::left, stretch.distance);
  put(HandMeasure::begin_distance, Side::left, stretch.begin_distance);
  put(HandMeasure::end_distance, Side::left, stretch.end_distance);
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

float measure_of(const PointOver& over, HandMeasure measure, const SignerBody& body) noexcept {
  const auto state = [&](const PointFrame& at) {
    return static_cast<float>(state_number(at.state, zone_of(at.position, body)));
  };
  switch (measure) {
    case HandMeasure::speed:
      return over.peak_speed;
    case HandMeasure::mean_speed:
      return over.mean_speed;
    case HandMeasure::acceleration:
      return over.peak_acceleration;
    case HandMeasure::mean_acceleration:
      return over.mean_acceleration;
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
    case HandMeasure::distance:
    case HandMeasure::begin_distance:
    case HandMeasure::end_distance:
      break;
  }
  return kNotKnown;
}

FrameRange measured_frames(TimeSpan span, const FrameClock& clock, std::int64_t frames) noexcept {
  const FrameRange asked = frames_of(span, clock);
  if (asked.empty() && 0 <= asked.begin && asked.begin < frames) return {asked.begin, asked.begin + 1};
  return clamp(asked, frames);
}

float least_distance(std::span<const PointFrame> a, std::span<const PointFrame> b, float shoulder_width) noexcept {
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const float apart = (a[i].position - b[i].position).norm();
    if (!(apart >= least)) least = apart;  // a number that is none stays
    if (std::isnan(least)) break;
  }
  return least * shoulder_width;
}

PointOver join(std::span<const PointOver> overs, std::span<const double> frames, float shoulder_width) noexcept {
  PointOver result = overs.front();
  result.end = overs.back().end;
  double weight = 0;
  double path = 0;
  double speeds = 0;
  double accelerations = 0;
  for (std::size_t i = 0; i < overs.size(); ++i) {
    const double share = std::max(frames[i], 1.0);
    weight += share;
    path += static_cast<double>(overs[i].path_length);
    speeds += share * static_cast<double>(overs[i].mean_speed);
    accelerations += share * static_cast<double>(overs[i].mean_acceleration);
    result.peak_speed = std::max(result.peak_speed, overs[i].peak_speed);
    result.peak_acceleration = std::max(result.peak_acceleration, overs[i].peak_acceleration);
    result.contact = result.contact | overs[i].contact;
  }
  if (overs.size() == 1) return result;
  result.path_length = static_cast<float>(path);
  result.mean_speed = static_cast<float>(speeds / weight);
  result.mean_acceleration = static_cast<float>(accelerations / weight);
  result.displacement = (result.end.position - result.begin.position).norm() * shoulder_width;
  return result;
}

MovementColumns measure_rows(std::span<const MovementRow> rows, const RecordingFeatures& features,
                             const HandTrace& trace, const FrameClock& clock, const Pause& pause) {
  MovementColumns columns;
  for (std::vector<float>& column : columns) column.assign(rows.size(), kNotKnown);
  struct Stroke {
    Milliseconds begin;
    Stretch stretch;
  };
  std::vector<std::vector<Stroke>> strokes(rows.size());
  std::size_t phase = 0;
  std::size_t calls = 0;
  const Pause pauses = [&] {  // rows are short mostly
    if (pause && (calls++ & 0xFU) == 0) pause();
  };
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (rows[row].kind == RowKind::sign) continue;
    const Stretch traced = from_trace(trace, measured_frames(rows[row].span, clock, trace.frames), pauses);
    if (rows[row].kind == RowKind::annotation) {
      write(traced, trace.body, row, columns);
      continue;
    }
    const std::size_t place = phase++;
    const bool measured = place < features.phases.size() && features.phases[place].known;
    const Stretch stretch = measured ? from_features(features.phases[place], traced) : traced;
    write(stretch, trace.body, row, columns);
    if (rows[row].phase == PhaseKind::stroke && rows[row].parent < rows.size()) {
      strokes[rows[row].parent].push_back({rows[row].span.begin, stretch});
    }
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (rows[row].kind != RowKind::sign) continue;
    pauses();
    std::ranges::stable_sort(strokes[row], {}, &Stroke::begin);
    std::vector<Stretch> stretches;
    for (const Stroke& stroke : strokes[row]) stretches.push_back(stroke.stretch);
    write(joined(stretches, trace.shoulder_width), trace.body, row, columns);
  }
  return columns;
}

}  // namespace signweave
