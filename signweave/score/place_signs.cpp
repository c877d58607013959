#include "signweave/score/place_signs.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace signweave {
namespace {

Milliseconds time_of(std::int64_t frame, FrameRate rate) {
  return Milliseconds(std::llround(static_cast<double>(frame) * 1000.0 * static_cast<double>(rate.denominator) /
                                   static_cast<double>(rate.numerator)));
}

/// The time range of a clip's signs: between the middles of the transitions on both sides.
struct Room {
  TimeSpan span;
  TimeSpan kept;               ///< the range of captured frames
  bool joined_before = false;  ///< it begins at a junction, not at the begin of the result
  bool joined_after = false;
  std::optional<TimeSpan> held = {};  ///< the end of the last stroke is held for this time
};

/// Places a clip's signs in output time. At junctions, the first sign begins and the last ends with the room.
void place_signs_of(const MotionClip& clip, const ShownClip& placed, std::size_t index, const Room& room,
                    Synthesis& out) {
  const FrameRate rate = out.motion.rate();
  const auto output_time = [&](Milliseconds recorded) {
    const double frame = clip.clock.frame_at(recorded);
    const double at = static_cast<double>(placed.core.begin) + (frame - placed.first_frame) / placed.step;
    const Milliseconds time(std::llround(at * 1000.0 / rate.hertz()));
    return std::clamp(time, room.span.begin, room.span.end);
  };
  for (std::size_t i = 0; i < clip.signs.size(); ++i) {
    const Sign& source = clip.signs[i];
    PlacedSign sign{.sign = source,
                    .channel = placed.channel,
                    .clip = index,
                    .place = place_of_sign(clip, i, index),
                    .recorded = source.span};
    const auto recorded_stroke = source.stroke_span();
    // True if the core begins or ends with the stroke. At a piece cut through a sign it does not; that sign is
    // unchanged.
    const auto meets = [&](Milliseconds recorded, std::int64_t frame) {
      return std::abs(clip.clock.frame_at(recorded) - static_cast<double>(frame)) <= 1.0;
    };
    const bool first = i == 0 && recorded_stroke && meets(recorded_stroke->begin, clip.core.begin);
    const bool last = i + 1 == clip.signs.size() && recorded_stroke && meets(recorded_stroke->end, clip.core.end);
    sign.sign.span = {first && room.joined_before ? room.span.begin : output_time(source.span.begin),
                      last && room.joined_after ? room.span.end : output_time(source.span.end)};
    std::vector<Phase> phases;
    if (!(first && room.joined_before) && !(last && room.joined_after)) {
      // Nothing of it was generated: its annotation is kept, including holds.
      for (const Phase& phase : source.phases) {
        phases.push_back({phase.kind, {output_time(phase.span.begin), output_time(phase.span.end)}, phase.label, {}});
        sign.sign.span = {std::min(sign.sign.span.begin, phases.back().span.begin),
                          std::max(sign.sign.span.end, phases.back().span.end)};
      }
      std::erase_if(phases, [](const Phase& phase) { return phase.span.duration() <= Milliseconds(0); });
      sign.sign.phases = std::move(phases);
      out.signs.push_back(std::move(sign));
      continue;
    }
    TimeSpan stroke{output_time(recorded_stroke->begin), output_time(recorded_stroke->end)};
    if (first) stroke.begin = time_of(placed.core.begin, rate);
    if (last) stroke.end = time_of(placed.core.end, rate);
    stroke.end = std::max(stroke.end, stroke.begin + Milliseconds(1));  // shorter than a frame, but not empty
    sign.sign.span = {std::min(sign.sign.span.begin, stroke.begin), std::max(sign.sign.span.end, stroke.end)};
    const auto add = [&](PhaseKind kind, TimeSpan span, const std::string& label) {
      if (span.begin < span.end) phases.push_back({kind, span, label, {}});
    };
    const auto label_of = [&](PhaseKind kind, const char* otherwise) {
      for (const Phase& phase : source.phases) {
        if (phase.kind == kind) return phase.label;
      }
      return std::string(otherwise);
    };
    // Preparation and retraction cover the generated frames; a kept hold inside them stays a hold.
    const auto surround = [&](PhaseKind kind, const std::string& label, TimeSpan all) {
      Milliseconds from = all.begin;
      if (kind == PhaseKind::retraction && last && room.held) {
        add(PhaseKind::hold, {from, room.held->end}, "Hold");
        from = std::max(from, room.held->end);
      }
      for (const Phase& phase : source.phases) {
        const bool inside = kind == PhaseKind::preparation ? phase.span.end <= recorded_stroke->begin
                                                           : phase.span.begin >= recorded_stroke->end;
        if (!inside || phase.kind == PhaseKind::preparation || phase.kind == PhaseKind::retraction) continue;
        const TimeSpan hold{std::max({from, output_time(phase.span.begin), room.kept.begin}),
                            std::min({all.end, output_time(phase.span.end), room.kept.end})};
        if (hold.begin >= hold.end) continue;
        add(kind, {from, hold.begin}, label);
        add(phase.kind, hold, phase.label);
        from = hold.end;
      }
      add(kind, {from, all.end}, label);
    };
    surround(PhaseKind::preparation, label_of(PhaseKind::preparation, "Preparation"),
             {sign.sign.span.begin, stroke.begin});
    Milliseconds at = stroke.begin;
    for (const Phase& phase : source.phases) {
      if (!recorded_stroke->contains(phase.span) || phase.span.duration() <= Milliseconds(0)) continue;
      const bool closes = phase.span.end == recorded_stroke->end;
      const Milliseconds end = closes ? stroke.end : std::min(output_time(phase.span.end), stroke.end);
      add(phase.kind, {at, end}, source.inferred ? "Stroke" : phase.label);
      at = std::max(at, end);
    }
    surround(PhaseKind::retraction, label_of(PhaseKind::retraction, "Retraction"), {stroke.end, sign.sign.span.end});
    sign.sign.phases = std::move(phases);
    out.signs.push_back(std::move(sign));
  }
}

/// The times for which the clips of the body are held, [clip]; empty: not held.
std::vector<TimeSpan> holds_of_body(const Synthesis& out) {
  std::vector<TimeSpan> holds(out.score.clips.size());
  for (const Item& item : out.score.lanes.front().items) {
    const auto* const held = std::get_if<Hold>(&item.what);
    if (held == nullptr || item.at.begin == 0) continue;
    holds[held->clip] = {time_of(item.at.begin, out.motion.rate()), time_of(item.at.end, out.motion.rate())};
  }
  return holds;
}

/// Places the signs of the clips that only this lane shows.
void place_signs_of_lane(const Lane& lane, const std::vector<MotionClip>& clips, std::size_t body, Synthesis& out) {
  const FrameRate rate = out.motion.rate();
  const std::vector<Item>& items = lane.items;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto* const use = std::get_if<ClipUse>(&items[i].what);
    if (use == nullptr || use->clip < body || out.clips[use->clip].channel != lane.channel) continue;
    const auto is_transition = [&](std::size_t at) {
      return at < items.size() && std::holds_alternative<Transition>(items[at].what);
    };
    const auto middle = [&](std::size_t at) { return time_of((items[at].at.begin + items[at].at.end) / 2, rate); };
    const bool is_held = i + 1 < items.size() && std::holds_alternative<Hold>(items[i + 1].what);
    const bool joined_before = i > 0 && is_transition(i - 1);
    const std::size_t after = is_held ? i + 2 : i + 1;
    Room room{.span = {joined_before ? middle(i - 1) : time_of(items[i].at.begin, rate),
                       is_transition(after) ? middle(after) : time_of(items[after - 1].at.end, rate)},
              .kept = {time_of(items[i].at.begin, rate), time_of(items[i].at.end, rate)},
              .joined_before = joined_before,
              .joined_after = is_transition(after)};
    if (is_held && is_transition(after)) {
      room.held = TimeSpan{time_of(items[i + 1].at.begin, rate), time_of(items[i + 1].at.end, rate)};
    }
    place_signs_of(clips[use->clip], out.clips[use->clip], use->clip, room, out);
  }
}

}  // namespace

void place_signs(const std::vector<MotionClip>& clips, Synthesis& out) {
  const FrameRate rate = out.motion.rate();
  const std::size_t body = body_clips(out.score);
  const std::vector<TimeSpan> held = holds_of_body(out);
  for (std::size_t i = 0; i < body; ++i) {
    // The boundary between two signs is the middle of the generated frames.
    const auto middle = [&](std::size_t junction) {
      const Junction& one = out.junctions[junction];
      const std::int64_t kept = one.cut.retraction_frames - one.cut.overlap();
      return time_of(one.frames.begin + kept + (one.cut.overlap() + one.cut.gap()) / 2, rate);
    };
    const bool last = i + 1 == body;
    const TimeSpan span{i == 0 ? Milliseconds(0) : middle(i - 1),
                        last ? time_of(out.motion.frame_count(), rate) : middle(i)};
    TimeSpan kept = span;
    if (i > 0) {
      const Junction& before = out.junctions[i - 1];
      kept.begin = time_of(before.frames.end - before.cut.preparation_frames + before.cut.overlap(), rate);
    }
    if (!last) {
      const Junction& after = out.junctions[i];
      kept.end = time_of(after.frames.begin + after.cut.retraction_frames - after.cut.overlap(), rate);
    }
    const bool is_held = held[i].begin < held[i].end && !last;
    place_signs_of(clips[i], out.clips[i], i,
                   {span, kept, i > 0, !last, is_held ? std::optional(held[i]) : std::nullopt}, out);
  }
  for (const Lane& lane : out.score.lanes) place_signs_of_lane(lane, clips, body, out);
}

}  // namespace signweave
