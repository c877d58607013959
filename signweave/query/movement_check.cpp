#include "signweave/query/movement_check.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace signweave {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The nearest float that is no more, or no less.
float not_above(double value) noexcept {
  const auto near = static_cast<float>(value);
  return static_cast<double>(near) > value ? std::nextafter(near, -kInfinity) : near;
}
float not_below(double value) noexcept {
  const auto near = static_cast<float>(value);
  return static_cast<double>(near) < value ? std::nextafter(near, kInfinity) : near;
}

HandMeasure measure_for(const Condition& condition) noexcept {
  const MovementTerm& term = condition.movement;
  const bool named = !std::holds_alternative<Amount>(condition.value);
  switch (term.quantity) {
    case Quantity::speed:
      return HandMeasure::speed;
    case Quantity::mean_speed:
      return HandMeasure::mean_speed;
    case Quantity::acceleration:
      return HandMeasure::acceleration;
    case Quantity::mean_acceleration:
      return HandMeasure::mean_acceleration;
    case Quantity::path:
      return HandMeasure::path;
    case Quantity::displacement:
      return HandMeasure::displacement;
    case Quantity::contact:
      return HandMeasure::contact;
    case Quantity::distance:
      return term.component == Component::begin ? HandMeasure::begin_distance
             : term.component == Component::end ? HandMeasure::end_distance
                                                : HandMeasure::distance;
    case Quantity::begin:
    case Quantity::end:
      break;
  }
  const bool begin = term.quantity == Quantity::begin;
  if (term.component == Component::x) return begin ? HandMeasure::begin_x : HandMeasure::end_x;
  if (!named && term.component == Component::height) return begin ? HandMeasure::begin_height : HandMeasure::end_height;
  if (!named && term.component == Component::forward)
    return begin ? HandMeasure::begin_forward : HandMeasure::end_forward;
  return begin ? HandMeasure::begin_state : HandMeasure::end_state;
}

/// Whether a column counts shoulder widths; else metres or something else.
bool in_shoulder_widths(HandMeasure measure) noexcept {
  return measure == HandMeasure::begin_x || measure == HandMeasure::begin_height ||
         measure == HandMeasure::begin_forward || measure == HandMeasure::end_x || measure == HandMeasure::end_height ||
         measure == HandMeasure::end_forward;
}

bool compares(auto a, Compare compare, auto b) noexcept {
  switch (compare) {
    case Compare::equal:
      return a == b;
    case Compare::not_equal:
      return a != b;
    case Compare::less:
      return a < b;
    case Compare::less_equal:
      return a <= b;
    case Compare::greater:
      return a > b;
    case Compare::greater_equal:
      return a >= b;
    case Compare::matches:
      break;
  }
  return false;
}

Across across_of(float x) noexcept {
  return x > kCentre ? Across::left : x < -kCentre ? Across::right : Across::centre;
}

}  // namespace

MovementCheck::MovementCheck(const Condition& condition, const Movement* movement)
    : movement_(movement), condition_(&condition) {
  const HandMeasure measure = measure_for(condition);
  by_state_ = measure == HandMeasure::begin_state || measure == HandMeasure::end_state;
  if (const Amount* amount = std::get_if<Amount>(&condition.value)) {
    scaled_ = (amount->unit == Unit::metres && in_shoulder_widths(measure)) ||
              (amount->unit == Unit::shoulder_widths && !in_shoulder_widths(measure));
  }
  if (movement_ == nullptr) return;
  const MovementTerm& term = condition.movement;
  const auto each_point = [](const Point& point, const auto& use) {
    if (point.kind != Point::Kind::hand) return use(point, false);
    for (const Side side : kSides) use(Point::palm(side), true);
  };
  each_point(term.point, [&](const Point& point, bool own) {
    if (!term.other) return ways_.push_back({point, std::nullopt, own, false, measure});
    each_point(*term.other, [&](const Point& other, bool other_own) {
      if (other != point) ways_.push_back({point, other, own, other_own, measure});
    });
  });
}

void MovementCheck::load(std::uint32_t recording) {
  if (recording_ == recording) return;
  recording_ = recording;
  for (Way& way : ways_) {
    const bool palms = way.point.kind == Point::Kind::palm && (!way.other || way.other->kind == Point::Kind::palm);
    if (palms) way.column = movement_->column({way.measure, way.point.side}, recording);
  }
  if (std::holds_alternative<Amount>(condition_->value)) bounds_ = bounds(recording);
}

MovementCheck::Bounds MovementCheck::bounds(std::uint32_t recording) const {
  const Amount& amount = std::get<Amount>(condition_->value);
  double value = amount.value;
  if (scaled_) {
    const auto width = static_cast<double>(movement_->shoulder_width(recording));
    if (!(width > 0)) return {kInfinity, -kInfinity};
    value = amount.unit == Unit::metres ? value / width : value * width;
  }
  // The column's numbers are floats, the value is not: turned so that no number is taken for another.
  switch (condition_->compare) {
    case Compare::less:
      return {-kInfinity, std::nextafter(not_below(value), -kInfinity)};
    case Compare::less_equal:
      return {-kInfinity, not_above(value)};
    case Compare::greater:
      return {std::nextafter(not_above(value), kInfinity), kInfinity};
    case Compare::greater_equal:
      return {not_below(value), kInfinity};
    case Compare::equal:
    case Compare::not_equal:
    case Compare::matches:
      break;
  }
  return {kInfinity, -kInfinity};
}

bool MovementCheck::fits(float value) const {
  if (std::isnan(value)) return false;
  const Compare compare = condition_->compare;
  if (const Across* across = std::get_if<Across>(&condition_->value)) {
    return compares(across_of(value), compare, *across);
  }
  if (const Contact* contact = std::get_if<Contact>(&condition_->value); contact != nullptr && !by_state_) {
    return has(static_cast<Contact>(static_cast<unsigned>(value)), *contact);
  }
  if (!by_state_) return bounds_.hold(value);
  const StateAndZone at = state_of(static_cast<std::uint32_t>(value));
  if (const Height* height = std::get_if<Height>(&condition_->value)) return compares(at.height, compare, *height);
  if (const Reach* reach = std::get_if<Reach>(&condition_->value)) return compares(at.reach, compare, *reach);
  if (const Contact* contact = std::get_if<Contact>(&condition_->value)) return has(at.state.contact, *contact);
  // Openness and directions are those of a hand with fingers.
  if (at.state.palm == Facing::unknown) return false;
  if (const Facing* facing = std::get_if<Facing>(&condition_->value)) {
    const bool palm = condition_->movement.component == Component::palm;
    return compares(palm ? at.state.palm : at.state.fingers, compare, *facing);
  }
  return bounds_.hold(at.state.openness);
}

bool MovementCheck::holds(const MovingRow& row, const Stretches& stretches) {
  if (ways_.empty()) return false;
  load(row.recording);
  std::optional<std::vector<TimeSpan>> looked_at;
  for (const Way& way : ways_) {
    const bool wrong =
        !row.any_hand && ((way.own && way.point.side != row.hand) || (way.other_own && way.other->side != row.hand));
    if (wrong) continue;
    if (!way.column.empty()) {
      if (fits(way.column[row.row])) return true;
      continue;
    }
    if (!looked_at) looked_at = stretches();
    if (fits(from_frames(way, row.recording, *looked_at))) return true;
  }
  return false;
}

PointTrack MovementCheck::track(const Point& point, std::uint32_t recording, const HandTrace& trace,
                                FrameRange frames) const {
  if (point.kind == Point::Kind::palm) return trace.track(palm_on(point.side), frames);
  for (const Side side : kSides) {
    if (point.part != finger_part(side, Finger::index, FingerPoint::tip)) continue;
    return trace.track(side == Side::left ? TracePoint::left_index : TracePoint::right_index, frames);
  }
  std::vector<PointTrack> tracks = movement_->points(recording, std::span(&point.part, 1), frames);
  return tracks.empty() ? PointTrack() : std::move(tracks.front());
}

float MovementCheck::from_frames(const Way& way, std::uint32_t recording, std::span<const TimeSpan> stretches) const {
  const std::shared_ptr<const HandTrace> trace = movement_->hands(recording);
  if (trace->samples() == 0) return kNotKnown;
  const FrameClock clock = movement_->clock(recording);
  std::vector<PointOver> overs;
  std::vector<double> weights;
  float least = kInfinity;
  float first = kNotKnown;
  float last = kNotKnown;
  for (const TimeSpan span : stretches) {
    const FrameRange frames = measured_frames(span, clock, trace->frames);
    const PointTrack points = frames.empty() ? PointTrack() : track(way.point, recording, *trace, frames);
    if (points.empty()) return kNotKnown;
    if (!way.other) {
      overs.push_back(over(points, trace->rate, trace->shoulder_width));
      weights.push_back(static_cast<double>(points.size()));
      continue;
    }
    const PointTrack others = track(*way.other, recording, *trace, frames);
    if (others.size() != points.size()) return kNotKnown;
    const auto apart = [&](const PointFrame& a, const PointFrame& b) {
      return (a.position - b.position).norm() * trace->shoulder_width;
    };
    const float near = least_distance(points, others, trace->shoulder_width);
    if (std::isnan(near)) return kNotKnown;
    if (least == kInfinity) first = apart(points.front(), others.front());
    last = apart(points.back(), others.back());
    least = std::min(least, near);
  }
  if (stretches.empty()) return kNotKnown;
  if (way.measure == HandMeasure::begin_distance) return first;
  if (way.measure == HandMeasure::end_distance) return last;
  if (way.measure == HandMeasure::distance) return least;
  const PointOver all = join(overs, weights, trace->shoulder_width);
  return std::isfinite(all.path_length) ? measure_of(all, way.measure, trace->body) : kNotKnown;
}

void MovementCheck::append_within(std::span<const float> column, Bounds bounds, RowId first, std::vector<RowId>& rows) {
  std::size_t i = 0;
#if defined(__SSE2__)
  // Sixteen at a time: where none of them fits, which is usual, nothing more is done.
  const __m128 low = _mm_set1_ps(bounds.low);
  const __m128 high = _mm_set1_ps(bounds.high);
  for (; i + 16 <= column.size(); i += 16) {
    unsigned mask = 0;
    for (unsigned k = 0; k < 4; ++k) {
      const __m128 values = _mm_loadu_ps(&column[i + 4 * k]);
      const __m128 within = _mm_and_ps(_mm_cmple_ps(low, values), _mm_cmple_ps(values, high));
      mask |= static_cast<unsigned>(_mm_movemask_ps(within)) << 4 * k;
    }
    for (; mask != 0; mask &= mask - 1) {
      rows.push_back(first + static_cast<RowId>(i) + static_cast<RowId>(std::countr_zero(mask)));
    }
  }
#endif
  for (; i < column.size(); ++i) {
    if (bounds.hold(column[i])) rows.push_back(first + static_cast<RowId>(i));
  }
}

bool MovementCheck::scannable() const noexcept {
  const MovementTerm& term = condition_->movement;
  return term.point.kind != Point::Kind::part && (!term.other || term.other->kind != Point::Kind::part);
}

bool MovementCheck::scan(std::uint32_t recording, RowId first, std::vector<RowId>& rows) {
  if (ways_.empty()) return true;
  load(recording);
  if (std::ranges::any_of(ways_, [](const Way& way) { return way.column.empty(); })) return false;
  const std::size_t before = rows.size();
  for (const Way& way : ways_) {
    if (!by_state_ && std::holds_alternative<Amount>(condition_->value)) {
      append_within(way.column, bounds_, first, rows);
      continue;
    }
    for (std::size_t i = 0; i < way.column.size(); ++i) {
      if (fits(way.column[i])) rows.push_back(first + static_cast<RowId>(i));
    }
  }
  if (ways_.size() < 2) return true;
  const auto from = rows.begin() + static_cast<std::ptrdiff_t>(before);
  std::sort(from, rows.end());
  rows.erase(std::unique(from, rows.end()), rows.end());
  return true;
}

}  // namespace signweave
