#include "signweave/query/movement_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "signweave/query/place_over.h"
#include "signweave/query/series_over.h"
#include "signweave/space/locus.h"

namespace signweave {
namespace {

/// The nearest float not above, or not below, a value.
float not_above(double value) noexcept {
  const auto near = static_cast<float>(value);
  return static_cast<double>(near) > value ? std::nextafter(near, -std::numeric_limits<float>::infinity()) : near;
}
float not_below(double value) noexcept {
  const auto near = static_cast<float>(value);
  return static_cast<double>(near) < value ? std::nextafter(near, std::numeric_limits<float>::infinity()) : near;
}

/// The measure of a component at the first or the last moment.
HandMeasure measure_at(bool begin, Component component, bool named) noexcept {
  if (component == Component::x) return begin ? HandMeasure::begin_x : HandMeasure::end_x;
  if (!named && component == Component::height) return begin ? HandMeasure::begin_height : HandMeasure::end_height;
  if (!named && component == Component::forward) return begin ? HandMeasure::begin_forward : HandMeasure::end_forward;
  return begin ? HandMeasure::begin_state : HandMeasure::end_state;
}

/// The measure of the maximum or minimum of a component.
HandMeasure measure_of_extent(bool most, Component component) noexcept {
  if (component == Component::x) return most ? HandMeasure::most_x : HandMeasure::least_x;
  if (component == Component::height) return most ? HandMeasure::most_height : HandMeasure::least_height;
  if (component == Component::forward) return most ? HandMeasure::most_forward : HandMeasure::least_forward;
  return most ? HandMeasure::most_openness : HandMeasure::least_openness;
}

bool is_equality(Compare compare) noexcept {
  return compare == Compare::equal || compare == Compare::not_equal;
}

/// The measure that decides `any`: above a number at some moment if the maximum is, below it if the minimum is.
HandMeasure measure_at_any(const Condition& condition) noexcept {
  const Component component = condition.movement.component;
  if (component == Component::contact) return HandMeasure::contact;
  if (component == Component::palm || component == Component::fingers) return HandMeasure::facings;
  if (is_equality(condition.compare)) return HandMeasure::zones;
  const bool most = condition.compare == Compare::greater || condition.compare == Compare::greater_equal;
  return measure_of_extent(most, component);
}

HandMeasure measure_for(const Condition& condition) noexcept {
  if (condition.field == Field::hands) return HandMeasure::hands;
  const MovementTerm& term = condition.movement;
  const bool least = term.component == Component::least;
  switch (term.quantity) {
    case Quantity::speed:
      return least ? HandMeasure::least_speed : HandMeasure::speed;
    case Quantity::mean_speed:
      return HandMeasure::mean_speed;
    case Quantity::acceleration:
      return least ? HandMeasure::least_acceleration : HandMeasure::acceleration;
    case Quantity::mean_acceleration:
      return HandMeasure::mean_acceleration;
    case Quantity::path:
      return HandMeasure::path;
    case Quantity::displacement:
      return HandMeasure::displacement;
    case Quantity::contact:
      return HandMeasure::contact;
    case Quantity::distance:
      return term.component == Component::begin  ? HandMeasure::begin_distance
             : term.component == Component::end  ? HandMeasure::end_distance
             : term.component == Component::most ? HandMeasure::most_distance
                                                 : HandMeasure::distance;
    case Quantity::begin:
    case Quantity::end:
      return measure_at(term.quantity == Quantity::begin, term.component,
                        !std::holds_alternative<Amount>(condition.value));
    case Quantity::max:
    case Quantity::min:
      return measure_of_extent(term.quantity == Quantity::max, term.component);
    case Quantity::any:
      return measure_at_any(condition);
    case Quantity::enters:
      return HandMeasure::entered;
    case Quantity::from:  // none of these has a measure: see place_over.h
    case Quantity::to:
    case Quantity::toward:
    case Quantity::at:
    case Quantity::track:
    case Quantity::mean_track:
    case Quantity::gaze:
    case Quantity::mean_gaze:
      break;
  }
  return HandMeasure::speed;
}

constexpr std::uint32_t kHandsBits = (1U << kHandsClasses.size()) - 1;

/// The bits of a set that meet a condition.
std::uint32_t mask_for(const Condition& condition) noexcept {
  const auto of = [&](std::uint32_t bit, std::uint32_t all) {
    return condition.compare == Compare::not_equal ? all & ~bit : bit;
  };
  if (const Height* height = std::get_if<Height>(&condition.value)) return of(bit_of(*height), kHeightBits);
  if (const Across* across = std::get_if<Across>(&condition.value)) return of(bit_of(*across), kAcrossBits);
  if (const Reach* reach = std::get_if<Reach>(&condition.value)) return of(bit_of(*reach), kReachBits);
  if (const Contact* contact = std::get_if<Contact>(&condition.value)) return static_cast<std::uint32_t>(*contact);
  if (const Hands* hands = std::get_if<Hands>(&condition.value)) return of(bit_of(*hands), kHandsBits);
  const Facing* facing = std::get_if<Facing>(&condition.value);
  if (facing == nullptr) return 0;
  return condition.movement.component == Component::palm ? of(palm_bit(*facing), kPalmBits)
                                                         : of(fingers_bit(*facing), kFingersBits);
}

/// Whether a column is in shoulder widths; otherwise it is in metres or another unit.
bool in_shoulder_widths(HandMeasure measure) noexcept {
  switch (measure) {
    case HandMeasure::begin_x:
    case HandMeasure::begin_height:
    case HandMeasure::begin_forward:
    case HandMeasure::end_x:
    case HandMeasure::end_height:
    case HandMeasure::end_forward:
    case HandMeasure::least_x:
    case HandMeasure::least_height:
    case HandMeasure::least_forward:
    case HandMeasure::most_x:
    case HandMeasure::most_height:
    case HandMeasure::most_forward:
      return true;
    default:
      return false;
  }
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

}  // namespace

MovementCheck::Reading MovementCheck::reading_of(const Condition& condition, HandMeasure measure) noexcept {
  switch (measure) {
    case HandMeasure::begin_state:
    case HandMeasure::end_state:
      return Reading::state;
    case HandMeasure::contact:
    case HandMeasure::zones:
    case HandMeasure::entered:
    case HandMeasure::facings:
    case HandMeasure::hands:
      return Reading::set;
    default:
      return condition.compare == Compare::not_equal ? Reading::outside : Reading::within;
  }
}

MovementCheck::MovementCheck(const Condition& condition, const Movement* movement)
    : movement_(movement), condition_(&condition) {
  if (is_series(condition.movement.quantity)) return;
  measure_ = measure_for(condition);
  reading_ = reading_of(condition, measure_);
  mask_ = mask_for(condition);
  if (const Amount* amount = std::get_if<Amount>(&condition.value)) {
    const bool in_widths = of_ends() || in_shoulder_widths(measure_);
    scaled_ = (amount->unit == Unit::metres && in_widths) || (amount->unit == Unit::shoulder_widths && !in_widths);
  }
  if (movement_ == nullptr) return;
  if (measure_ == HandMeasure::hands) {
    alternatives_.push_back({.point = Point::palm(Side::left), .other = Point::palm(Side::right)});
    return;
  }
  const MovementTerm& term = condition.movement;
  const auto each_point = [](const Point& point, const auto& use) {
    if (point.kind != Point::Kind::hand) return use(point, false);
    for (const Side side : kSides) use(Point::palm(side), true);
  };
  each_point(term.point, [&](const Point& point, bool own) {
    if (!term.other) return alternatives_.push_back({point, std::nullopt, own, false});
    each_point(*term.other, [&](const Point& other, bool other_own) {
      if (other != point) alternatives_.push_back({point, other, own, other_own});
    });
  });
}

void MovementCheck::load(std::uint32_t recording) {
  if (recording_ == recording) return;
  recording_.reset();  // if the code below is interrupted, nothing of it is loaded
  series_values_.clear();
  if (is_aim(condition_->movement.quantity)) {
    const LocusRef& locus = condition_->movement.locus;
    const bool of_body = locus.name == "self";
    locus_ = resolve(locus, {}, 0, of_body ? movement_->hands(recording)->body : SignerBody()).at;
  }
  for (Alternative& alternative : alternatives_) {
    alternative.angles.clear();
    if (of_ends()) load_ends(alternative, recording);
    if (is_place(condition_->movement.quantity) || is_aim(condition_->movement.quantity)) continue;
    const bool palms = alternative.point.kind == Point::Kind::palm &&
                       (!alternative.other || alternative.other->kind == Point::Kind::palm);
    if (palms) alternative.column = movement_->column({measure_, alternative.point.side}, recording);
  }
  const bool number = std::holds_alternative<Amount>(condition_->value);
  if (number) bounds_ = bounds_of_amount(recording);
  if (!number && (reading_ == Reading::within || reading_ == Reading::outside)) bounds_ = bounds_of_zone(recording);
  recording_ = recording;
}

void MovementCheck::load_ends(Alternative& alternative, std::uint32_t recording) {
  if (alternative.point.kind != Point::Kind::palm) return;
  constexpr std::array kEnds = {HandMeasure::begin_x, HandMeasure::begin_height, HandMeasure::begin_forward,
                                HandMeasure::end_x,   HandMeasure::end_height,   HandMeasure::end_forward};
  for (std::size_t i = 0; i < kEnds.size(); ++i) {
    alternative.ends[i] = movement_->column({kEnds[i], alternative.point.side}, recording);
  }
}

bool MovementCheck::is_stored(const Alternative& alternative) const noexcept {
  return !(of_ends() ? alternative.ends.front() : alternative.column).values.empty();
}

float MovementCheck::stored_value(const Alternative& alternative, RowId row) const {
  if (!of_ends()) return alternative.column.values[row];
  const auto at = [&](std::size_t first) {
    return Eigen::Vector3f(alternative.ends[first].values[row], alternative.ends[first + 1].values[row],
                           alternative.ends[first + 2].values[row]);
  };
  return place_over(condition_->movement, {.begin = at(0), .end = at(3)}, locus_);
}

/// A row may be tested repeatedly, as a partner of others, and its finger is read from the motion.
float MovementCheck::computed_value(Alternative& alternative, const MovingRow& row, std::span<const TimeSpan> spans) {
  if (condition_->movement.quantity != Quantity::at) return from_frames(alternative, row.recording, spans);
  std::vector<float>& angles = alternative.angles;
  if (angles.size() <= row.row) angles.resize(row.row + 1, kUnbounded);
  if (std::isinf(angles[row.row])) {
    angles[row.row] = pointing_over(*movement_, row.recording, alternative.point.side, spans, locus_);
  }
  return angles[row.row];
}

MovementCheck::Bounds MovementCheck::bounds_of_amount(std::uint32_t recording) const {
  const Amount& amount = std::get<Amount>(condition_->value);
  double value = amount.value;
  if (scaled_) {
    const auto width = static_cast<double>(movement_->shoulder_width(recording));
    if (!(width > 0)) return {kUnbounded, -kUnbounded};
    value = amount.unit == Unit::metres ? value / width : value * width;
  }
  // The column's values are floats, the condition's value is a double: rounded so that no comparison changes its
  // result.
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

/// Bounds of a named zone, from the borders that `zone_of` uses.
MovementCheck::Bounds MovementCheck::bounds_of_zone(std::uint32_t recording) const {
  const auto below = [](float value) { return std::nextafter(value, -kUnbounded); };
  const auto above = [](float value) { return std::nextafter(value, kUnbounded); };
  const auto body = [&] { return movement_->hands(recording)->body; };
  Bounds zone{-kUnbounded, kUnbounded};
  if (const Height* height = std::get_if<Height>(&condition_->value)) {
    const auto i = static_cast<std::size_t>(*height);
    const std::array<float, 8> borders = body().heights;
    if (i > 0) zone.low = borders[i];
    if (i + 1 < borders.size()) zone.high = below(borders[i + 1]);
  } else if (const Across* across = std::get_if<Across>(&condition_->value)) {
    if (*across != Across::right) zone.low = *across == Across::left ? above(kCentre) : -kCentre;
    if (*across != Across::left) zone.high = *across == Across::right ? below(-kCentre) : kCentre;
  } else if (const Reach* reach = std::get_if<Reach>(&condition_->value)) {
    const float border = body().near_reach;
    if (*reach == Reach::far) zone.low = above(border);
    if (*reach == Reach::near) zone.high = border;
  }
  switch (condition_->compare) {
    case Compare::less:
      return {-kUnbounded, below(zone.low)};
    case Compare::less_equal:
      return {-kUnbounded, zone.high};
    case Compare::greater:
      return {above(zone.high), kUnbounded};
    case Compare::greater_equal:
      return {zone.low, kUnbounded};
    case Compare::equal:
    case Compare::not_equal:
    case Compare::matches:
      break;
  }
  return zone;
}

bool MovementCheck::fits(float value) const {
  if (std::isnan(value)) return false;
  switch (reading_) {
    case Reading::within:
      return bounds_.hold(value);
    case Reading::outside:
      return !bounds_.hold(value);
    case Reading::set:
      return (static_cast<std::uint32_t>(value) & mask_) != 0;
    case Reading::state:
      break;
  }
  const Compare compare = condition_->compare;
  const StateAndZone at = state_of(static_cast<std::uint32_t>(value));
  if (const Height* height = std::get_if<Height>(&condition_->value)) return compares(at.height, compare, *height);
  if (const Reach* reach = std::get_if<Reach>(&condition_->value)) return compares(at.reach, compare, *reach);
  if (const Contact* contact = std::get_if<Contact>(&condition_->value)) return has(at.state.contact, *contact);
  // Openness and directions apply only to a hand with fingers.
  if (at.state.palm == Facing::unknown) return false;
  if (const Facing* facing = std::get_if<Facing>(&condition_->value)) {
    const bool palm = condition_->movement.component == Component::palm;
    return compares(palm ? at.state.palm : at.state.fingers, compare, *facing);
  }
  return bounds_.hold(at.state.openness);
}

bool MovementCheck::holds(const MovingRow& row, const MeasuredSpans& spans) {
  if (movement_ != nullptr && is_series(condition_->movement.quantity)) {
    load(row.recording);
    return fits(series_of(row, spans));
  }
  if (alternatives_.empty()) return false;
  load(row.recording);
  std::optional<std::vector<TimeSpan>> measured;
  for (Alternative& alternative : alternatives_) {
    const bool wrong = !row.any_hand && ((alternative.own && alternative.point.side != row.hand) ||
                                         (alternative.other_own && alternative.other->side != row.hand));
    if (wrong) continue;
    if (is_stored(alternative)) {
      if (fits(stored_value(alternative, row.row))) return true;
      continue;
    }
    if (!measured) measured = spans();
    if (fits(computed_value(alternative, row, *measured))) return true;
  }
  return false;
}

/// A row may be tested repeatedly, as a partner of others.
float MovementCheck::series_of(const MovingRow& row, const MeasuredSpans& spans) {
  if (series_values_.size() <= row.row) series_values_.resize(row.row + 1, kUnbounded);
  if (std::isinf(series_values_[row.row])) {
    series_values_[row.row] = series_over(condition_->movement, *movement_, row.recording, spans());
  }
  return series_values_[row.row];
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

float MovementCheck::from_frames(const Alternative& alternative, std::uint32_t recording,
                                 std::span<const TimeSpan> spans) const {
  const std::shared_ptr<const HandTrace> trace = movement_->hands(recording);
  if (trace->samples() == 0 || spans.empty()) return kNotKnown;
  const FrameClock clock = movement_->clock(recording);
  std::vector<Course> courses;
  std::vector<double> weights;
  PointTrack points;
  PointTrack others;
  Distances apart;
  TwoHandedSum both;
  bool known = true;
  for (const TimeSpan span : spans) {
    const FrameRange frames = measured_frames(span, clock, trace->frames);
    if (frames.empty()) return kNotKnown;
    CourseSum sum(trace->body);
    for_pieces(
        frames, [this] { movement_->pause(); },
        [&](FrameRange piece) {
          if (!known) return;
          track(alternative.point, recording, *trace, piece, points);
          known = !points.empty();
          if (!known) return;
          if (!alternative.other) {
            for (const PointFrame& point : points) sum.add(point);
            return;
          }
          track(*alternative.other, recording, *trace, piece, others);
          known = others.size() == points.size() && apart.add(points, others, trace->shoulder_width);
          if (known && measure_ == HandMeasure::hands) both.add(points, others);
        });
    if (!known) return kNotKnown;
    if (alternative.other) continue;
    courses.push_back(sum.course(trace->rate, trace->shoulder_width));
    weights.push_back(static_cast<double>(frames.size()));
  }
  if (measure_ == HandMeasure::hands) return hands_of(both, trace->body);
  if (alternative.other) return apart[measure_];
  const Course all = join(courses, weights, trace->shoulder_width);
  if (of_ends()) {
    return place_over(condition_->movement, {.begin = all.over.begin.position, .end = all.over.end.position}, locus_);
  }
  return std::isfinite(all.over.path_length) ? measure_of(all, measure_, trace->body) : kNotKnown;
}

}  // namespace signweave
