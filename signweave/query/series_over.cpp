#include "signweave/query/series_over.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "signweave/core/text.h"
#include "signweave/query/lexer.h"

namespace signweave {
namespace {

/// Accumulates a statistic of values that arrive one by one.
struct SeriesSum {
  float first = kNotKnown;
  float last = kNotKnown;
  float most = kNotKnown;
  float least = kNotKnown;
  double sum = 0;
  std::int64_t count = 0;

  void add(float value) noexcept {
    if (count++ == 0) first = most = least = value;
    last = value;
    most = std::max(most, value);
    least = std::min(least, value);
    sum += static_cast<double>(value);
  }
};

float asked_for(const MovementTerm& term, const SeriesSum& sum) noexcept {
  if (sum.count == 0) return kNotKnown;
  if (term.quantity == Quantity::mean_track || term.quantity == Quantity::mean_gaze) {
    return static_cast<float>(sum.sum / static_cast<double>(sum.count));
  }
  if (term.component == Component::begin) return sum.first;
  if (term.component == Component::end) return sum.last;
  return term.component == Component::least ? sum.least : sum.most;
}

/// Its values at some frames; empty: not known.
std::vector<float> values_of(const MovementTerm& term, const Movement& movement, std::uint32_t recording,
                             FrameRange frames) {
  if (!is_gaze(term.quantity)) return movement.track(recording, term.track, frames);
  std::vector<float> values;
  for (const Gaze& gaze : movement.gaze(recording, frames)) {
    values.push_back(term.angle == GazeAngle::yaw ? gaze.yaw : gaze.pitch);
  }
  return values;
}

void require_tracks(const Expression& expression, const Movement& movement) {
  if (expression.kind == Expression::Kind::condition && expression.condition.field == Field::movement) {
    const MovementTerm& term = expression.condition.movement;
    const bool track = is_series(term.quantity) && !is_gaze(term.quantity);
    if (!track || movement.has_track(term.track)) return;
    const std::vector<std::string> known = movement.tracks();
    const std::string hint =
        known.empty() ? "; import a face capture, NAME.face.csv, with its motion" : did_you_mean(term.track, known);
    throw Error(ErrorCode::not_found, fmt::format("{}({}): no recording of this database has such a scalar track{}",
                                                  word_of(term.quantity), in_quotes(printable(term.track)), hint));
  }
  for (const Expression& operand : expression.operands) require_tracks(operand, movement);
  for (const PhaseQuery& sequence : expression.sequence) require_tracks(sequence, movement);
}

}  // namespace

void require_tracks(const PhaseQuery& query, const Movement& movement) {
  for_parts(query, [&](const Term& term) { require_tracks(term.expression, movement); });
}

float series_over(const MovementTerm& term, const Movement& movement, std::uint32_t recording,
                  std::span<const TimeSpan> spans) {
  const FrameClock clock = movement.clock(recording);
  const std::int64_t count = movement.frame_count(recording);
  SeriesSum sum;
  bool known = !spans.empty();
  for (const TimeSpan span : spans) {
    const FrameRange frames = measured_frames(span, clock, count);
    known = known && !frames.empty();
    if (!known) break;
    for_pieces(
        frames, [&] { movement.pause(); },
        [&](FrameRange piece) {
          if (!known) return;
          const std::vector<float> values = values_of(term, movement, recording, piece);
          known = !values.empty() && std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
          if (!known) return;
          for (const float value : values) sum.add(value);
        });
  }
  const float value = known ? asked_for(term, sum) : kNotKnown;
  return std::isfinite(value) ? value : kNotKnown;
}

}  // namespace signweave
