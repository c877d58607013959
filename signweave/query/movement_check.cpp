#include "signweave/query/movement_check.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "signweave/features/point_sum.h"
#include "signweave/query/series_over.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace signweave {
namespace {

constexpr float kUnbounded = std::numeric_limits<float>::infinity();

/// The nearest float that is no more, or no less.
float not_above(double value) noexcept {
  const auto near = static_cast<float>(value);
  return static_cast<double>(near) > value ? std::nextafter(near, -kUnbounded) : near;
}
float not_below(double value) noexcept {
  const auto near = static_cast<float>(value);
  return static_cast<double>(near) < value ? std::nextafter(near, kUnbounded) : near;
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
    case Quantity::track:
    case Quantity::mean_track:
    case Quantity::gaze:
    case Quantity::mean_gaze:
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
  if (is_series(condition.movement.quantity)) return;
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
  recording_.reset();  // where it is stopped below, nothing of it is at hand
  told_.clear();
  for (Way& way : ways_) {
    const bool palms = way.point.kind == Point::Kind::palm && (!way.other || way.other->kind == Point::Kind::palm);
    if (palms) way.column = movement_->column({way.measure, way.point.side}, recording);
  }
  if (std::holds_alternative<Amount>(condition_->value)) bounds_ = bounds(recording);
  recording_ = recording;
}

MovementCheck::Bounds MovementCheck::bounds(std::uint32_t recording) const {
  const Amount& amount = std::get<Amount>(condition_->value);
  double value = amount.value;
  if (scaled_) {
    const auto width = static_cast<double>(movement_->shoulder_width(recording));
    if (!(width > 0)) return {kUnbounded, -kUnbounded};
    value = amount.unit == Unit::metres ? value / width : value * width;
  }
  // The column's numbers are floats, the value is not: turned so that no number is taken for another.
  switch (condition_->compare) {
    case Compare::less:
      return {-kUnbounded, std::nextafter(not_below(value), -kUnbounded)};
    case Compare::less_equal:
      return {-kUnbounded, not_above(value)};
    case Compare::greater:
      return {std::nextafter(not_above(value), kUnbounded), kUnbounded};
    case Compare::greater_equal:
      return {not_below(value), kUnbounded};
    case Compare::equal:
    case Compare::not_equal:
    case Compare::matches:
      break;
  }
  return {kUnbounded, -kUnbounded};
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
  if (movement_ != nullptr && is_series(condition_->movement.quantity)) {
    load(row.recording);
    return fits(series_of(row, stretches));
  }
  if (ways_.empty()) return false;
  load(row.recording);
  std::optional<std::vector<TimeSpan>> looked_at;
  for (const Way& way : ways_) {
    const bool wrong =
        !row.any_hand && ((way.own && way.point.side != row.hand) || (way.other_own && way.other->side != row.hand));
    if (wrong) continue;
    if (!way.column.values.empty()) {
      if (fits(way.column.values[row.row])) return true;
      continue;
    }
    if (!looked_at) looked_at = stretches();
    if (fits(from_frames(way, row.recording, *looked_at))) return true;
  }
  return false;
}

/// A row may be asked about again and again, as a partner of others.
float MovementCheck::series_of(const MovingRow& row, const Stretches& stretches) {
  if (told_.size() <= row.row) told_.resize(row.row + 1, kUnbounded);
  if (std::isinf(told_[row.row])) {
    told_[row.row] = series_over(condition_->movement, *movement_, row.recording, stretches());
  }
  return told_[row.row];
}

void MovementCheck::track(const Point& point, std::uint32_t recording, const HandTrace& trace, FrameRange frames,
                          PointTrack& out) const {
  if (point.kind == Point::Kind::palm) return trace.track(palm_on(point.side), frames, out);
  for (const Side side : kSides) {
    if (point.part != finger_part(side, Finger::index, FingerPoint::tip)) continue;
    return trace.track(side == Side::left ? TracePoint::left_index : TracePoint::right_index, frames, out);
  }
  std::vector<PointTrack> tracks = movement_->points(recording, std::span(&point.part, 1), frames);
  out = tracks.empty() ? PointTrack() : std::move(tracks.front());
}

float MovementCheck::from_frames(const Way& way, std::uint32_t recording, std::span<const TimeSpan> stretches) const {
  const std::shared_ptr<const HandTrace> trace = movement_->hands(recording);
  if (trace->samples() == 0 || stretches.empty()) return kNotKnown;
  const FrameClock clock = movement_->clock(recording);
  const auto apart = [&](const PointFrame& a, const PointFrame& b) {
    return (a.position - b.position).norm() * trace->shoulder_width;
  };
  std::vector<PointOver> overs;
  std::vector<double> weights;
  PointTrack points;
  PointTrack others;
  float least = kUnbounded;
  float first = kNotKnown;
  float last = kNotKnown;
  bool known = true;
  for (const TimeSpan span : stretches) {
    const FrameRange frames = measured_frames(span, clock, trace->frames);
    if (frames.empty()) return kNotKnown;
    PointSum sum;
    for_pieces(
        frames, [this] { movement_->pause(); },
        [&](FrameRange piece) {
          if (!known) return;
          track(way.point, recording, *trace, piece, points);
          known = !points.empty();
          if (!known) return;
          if (!way.other) {
            for (const PointFrame& point : points) sum.add(point);
            return;
          }
          track(*way.other, recording, *trace, piece, others);
          const float near =
              others.size() == points.size() ? least_distance(points, others, trace->shoulder_width) : kNotKnown;
          known = !std::isnan(near);
          if (!known) return;
          if (least == kUnbounded) first = apart(points.front(), others.front());
          last = apart(points.back(), others.back());
          least = std::min(least, near);
        });
    if (!known) return kNotKnown;
    if (way.other) continue;
    overs.push_back(sum.over(trace->rate, trace->shoulder_width));
    weights.push_back(static_cast<double>(frames.size()));
  }
  if (way.measure == HandMeasure::begin_distance) return first;
  if (way.measure == HandMeasure::end_distance) return last;
  if (way.measure == HandMeasure::distance) return least;
  const PointOver all = join(overs, weights, trace->shoulder_width);
  return std::isfinite(all.path_length) ? measure_of(all, way.measure, trace->body) : kNotKnown;
}

#if defined(__SSE2__)
namespace {

/// Which of four numbers are no less than `low` and no more than `high`; a bound that is infinite is not looked at.
template <bool kLow, bool kHigh>
__m128 within(const float* values, __m128 low, __m128 high) noexcept {
  const __m128 four = _mm_loadu_ps(values);
  if constexpr (!kLow) return _mm_cmple_ps(four, high);
  if constexpr (!kHigh) return _mm_cmple_ps(low, four);
  return _mm_and_ps(_mm_cmple_ps(low, four), _mm_cmple_ps(four, high));
}

/// Appends `first` + the places of what lies within, of the first multiple of 64 numbers; gives how many those are.
template <bool kLow, bool kHigh>
std::size_t append_blocks(std::span<const float> column, float low_bound, float high_bound, RowId first,
                          std::vector<RowId>& rows) {
  constexpr std::size_t kBlock = 64;
  const __m128 low = _mm_set1_ps(low_bound);
  const __m128 high = _mm_set1_ps(high_bound);
  std::size_t i = 0;
  for (; i + kBlock <= column.size(); i += kBlock) {
    // Of most blocks nothing fits: that is told first, with one branch.
    const float* values = column.data() + i;
    __m128 any[4];
    for (std::size_t k = 0; k < 4; ++k) any[k] = within<kLow, kHigh>(values + 4 * k, low, high);
    for (std::size_t k = 4; k < kBlock / 4; ++k) {
      any[k % 4] = _mm_or_ps(any[k % 4], within<kLow, kHigh>(values + 4 * k, low, high));
    }
    if (_mm_movemask_ps(_mm_or_ps(_mm_or_ps(any[0], any[1]), _mm_or_ps(any[2], any[3]))) == 0) continue;
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < kBlock / 4; ++k) {
      const auto four = static_cast<unsigned>(_mm_movemask_ps(within<kLow, kHigh>(values + 4 * k, low, high)));
      bits |= std::uint64_t{four} << 4 * k;
    }
    std::size_t end = rows.size();
    rows.resize(end + static_cast<std::size_t>(std::popcount(bits)));
    for (; bits != 0; bits &= bits - 1) {
      rows[end++] = first + static_cast<RowId>(i) + static_cast<RowId>(std::countr_zero(bits));
    }
  }
  return i;
}

}  // namespace
#endif

void MovementCheck::append_within(std::span<const float> column, Bounds bounds, RowId first, std::vector<RowId>& rows) {
  std::size_t i = 0;
#if defined(__SSE2__)
  const auto append = bounds.high == kUnbounded   ? append_blocks<true, false>
                      : bounds.low == -kUnbounded ? append_blocks<false, true>
                                                  : append_blocks<true, true>;
  i = append(column, bounds.low, bounds.high, first, rows);
#endif
  for (; i < column.size(); ++i) {
    if (bounds.hold(column[i])) rows.push_back(first + static_cast<RowId>(i));
  }
}

bool is_scannable(const MovementTerm& term) noexcept {
  return !is_series(term.quantity) && term.point.kind != Point::Kind::part &&
         (!term.other || term.other->kind != Point::Kind::part);
}

bool MovementCheck::scan(std::uint32_t recording, RowId first, std::vector<RowId>& rows) {
  if (is_series(condition_->movement.quantity)) return false;
  if (ways_.empty()) return true;
  load(recording);
  if (std::ranges::any_of(ways_, [](const Way& way) { return way.column.values.empty(); })) return false;
  const std::size_t before = rows.size();
  for (const Way& way : ways_) {
    if (!by_state_ && std::holds_alternative<Amount>(condition_->value)) {
      append_within(way.column.values, bounds_, first, rows);
      continue;
    }
    for (std::size_t i = 0; i < way.column.values.size(); ++i) {
      if (fits(way.column.values[i])) rows.push_back(first + static_cast<RowId>(i));
    }
  }
  if (ways_.size() < 2) return true;
  const auto from = rows.begin() + static_cast<std::ptrdiff_t>(before);
  std::sort(from, rows.end());
  rows.erase(std::unique(from, rows.end()), rows.end());
  return true;
}

}  // namespace signweave
