#include "signweave/query/rank.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/text.h"

namespace signweave {
namespace {

const Condition* example_in(const Expression& expression) noexcept {
  if (expression.kind == Expression::Kind::condition) {
    return expression.condition.field == Field::like ? &expression.condition : nullptr;
  }
  if (expression.kind != Expression::Kind::all) return nullptr;
  for (const Expression& operand : expression.operands) {
    if (const Condition* found = example_in(operand)) return found;
  }
  return nullptr;
}

std::uint32_t recording_called(const std::string& name, const Segments& segments) {
  if (const std::uint32_t exact = segments.find_recording(name); exact != Segments::kNone) return exact;
  const std::string wanted = match_form(name);
  const std::vector<std::string> known = segments.recordings();
  const auto at = std::ranges::find_if(known, [&](const std::string& one) { return match_form(one) == wanted; });
  if (at != known.end()) return static_cast<std::uint32_t>(at - known.begin());
  throw Error(ErrorCode::not_found,
              fmt::format("like(…): no recording '{}' in this database{}", printable(name), did_you_mean(name, known)));
}

/// The trace point of a point, if traces store it.
std::optional<TracePoint> traced(const Point& point) noexcept {
  if (point.kind == Point::Kind::palm) return palm_on(point.side);
  if (point == Point::of(finger_part(Side::left, Finger::index, FingerPoint::tip))) return TracePoint::left_index;
  if (point == Point::of(finger_part(Side::right, Finger::index, FingerPoint::tip))) return TracePoint::right_index;
  return std::nullopt;
}

}  // namespace

std::optional<std::size_t> ranked_place(const PhaseQuery& query) noexcept {
  for (std::size_t place = 0; place < query.elements.size(); ++place) {
    if (example_in(query.elements[place].term.expression) != nullptr) return place;
  }
  return std::nullopt;
}

const Example& example_at(const PhaseQuery& query, std::size_t place) noexcept {
  return std::get<Example>(example_in(query.elements[place].term.expression)->value);
}

RankedExample::RankedExample(const Example& example, const Segments& segments, const Movement* movement)
    : movement_(movement) {
  const std::uint32_t recording = recording_called(example.recording, segments);
  const std::string name = printable(example.recording);
  if (movement_ != nullptr) load(recording);
  if (movement_ == nullptr || trace_->samples() == 0) {
    const std::string why = trace_ ? trace_->why_not : "there is no motion";
    throw Error(ErrorCode::not_found, fmt::format("like(…): the hands are not known in '{}': {}", name, why));
  }
  const FrameRange frames = measured_frames(example.span, clock_, trace_->frames);
  if (frames.empty()) {
    const TimeSpan whole = span_of({0, trace_->frames}, clock_);
    throw Error(ErrorCode::bad_input, fmt::format("like(…): {}..{} lies outside the motion of '{}', which is from "
                                                  "{} to {} ms",
                                                  example.span.begin.count(), example.span.end.count(), name,
                                                  whole.begin.count(), whole.end.count()));
  }
  const bool named = !example.points.empty();
  const std::vector<Point> wanted =
      named ? example.points : std::vector<Point>{Point::palm(Side::right), Point::palm(Side::left)};
  for (const Point& point : wanted) {
    PointShape shape;
    if (resample_point(point, recording, frames, shape)) {
      points_.push_back(point);
      shape_.push_back(shape);
    } else if (named) {
      throw Error(ErrorCode::not_found,
                  fmt::format("like(…): '{}' is not known in '{}' from {} to {} ms; name other points",
                              to_string(point), name, example.span.begin.count(), example.span.end.count()));
    }
  }
  for (const Point& point : points_) {
    if (const std::optional<TracePoint> kept = traced(point)) traced_.push_back(*kept);
  }
  if (traced_.size() < points_.size()) traced_.clear();
  if (points_.empty()) {
    throw Error(ErrorCode::not_found,
                fmt::format("like(…): neither hand is known in '{}' from {} to {} ms; name another span", name,
                            example.span.begin.count(), example.span.end.count()));
  }
}

void RankedExample::load(std::uint32_t recording) {
  if (recording_ == recording) return;
  movement_->pause();
  recording_ = recording;
  trace_ = movement_->hands(recording);
  clock_ = movement_->clock(recording);
}

bool RankedExample::resample_point(const Point& point, std::uint32_t recording, FrameRange frames,
                                   PointShape& out) const {
  if (const std::optional<TracePoint> kept = traced(point)) {
    return !(*trace_)[*kept].empty() && resample(*trace_, *kept, frames, out);
  }
  const std::vector<PointTrack> tracks = movement_->points(recording, std::span(&point.part, 1), frames);
  return !tracks.empty() && !tracks.front().empty() && resample(tracks.front(), trace_->shoulder_width, out);
}

void RankedExample::offer(std::uint32_t id, std::uint32_t recording, TimeSpan span, NearestSearch& search) {
  load(recording);
  if (trace_->samples() == 0) return;
  const FrameRange frames = measured_frames(span, clock_, trace_->frames);
  if (frames.empty()) return;
  const bool at_hand =
      !traced_.empty() && std::ranges::none_of(traced_, [&](TracePoint point) { return (*trace_)[point].empty(); });
  if (at_hand && search.too_far(TraceSpan(*trace_, frames), traced_)) return;
  candidate_.resize(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!resample_point(points_[i], recording, frames, candidate_[i])) return;
  }
  search.offer(id, candidate_);
}

}  // namespace signweave
