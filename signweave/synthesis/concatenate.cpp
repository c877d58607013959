#include "signweave/synthesis/concatenate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "signweave/core/error.h"
#include "signweave/motion/blend.h"

namespace signweave {
namespace {

/// A stretch on the output's time grid: output frame k of it shows the recording's frame core.begin + k · step.
/// Negative k are its preparation, k ≥ core_frames its retraction.
struct Laid {
  const Stretch* source = nullptr;
  GroundTransform transform;
  bool aligned = false;
  double step = 1;
  std::int64_t preparation = 0;  ///< output frames before the core that were captured
  std::int64_t core_frames = 1;
  std::int64_t retraction = 0;  ///< output frames after it

  double frame_at(std::int64_t k) const noexcept {
    const double frame = static_cast<double>(source->core.begin) + static_cast<double>(k) * step;
    return std::clamp(frame, static_cast<double>(source->frames.begin), static_cast<double>(source->frames.end - 1));
  }
  void pose_at(std::int64_t k, MutablePoseView out) const noexcept {
    sample(source->motion, frame_at(k) - static_cast<double>(source->frames.begin), out);
    if (aligned) apply(transform, out);
  }
};

void check_skeletons(const std::vector<Stretch>& stretches, const Stretch& reference) {
  for (const Stretch& stretch : stretches) {
    const auto differs = difference(reference.motion.skeleton(), stretch.motion.skeleton());
    if (!differs) continue;
    throw Error(ErrorCode::bad_input,
                fmt::format("recordings '{}' and '{}' have different skeletons: {}; only motions with "
                            "the same joints can be joined",
                            reference.recording, stretch.recording, *differs));
  }
}

FrameRate highest_rate(const std::vector<Stretch>& stretches) {
  FrameRate highest = stretches[0].motion.rate();
  for (const Stretch& stretch : stretches) {
    if (stretch.motion.rate().hertz() > highest.hertz()) highest = stretch.motion.rate();
  }
  return highest;
}

FrameRange within(const Stretch& stretch, FrameRange frames) {
  return {frames.begin - stretch.frames.begin, frames.end - stretch.frames.begin};
}

Laid lay(const Stretch& stretch, const ConcatenateOptions& options, FrameRate rate, const Standing& home, bool own) {
  Laid laid;
  laid.source = &stretch;
  laid.step =
      stretch.motion.rate() == rate ? options.tempo : stretch.motion.rate().hertz() / rate.hertz() * options.tempo;
  const auto frames = [&](std::int64_t count) {
    return static_cast<std::int64_t>(static_cast<double>(count) / laid.step + 1e-9);
  };
  laid.core_frames = std::max<std::int64_t>(1, std::llround(static_cast<double>(stretch.core.size()) / laid.step));
  laid.preparation = frames(stretch.core.begin - stretch.whole.begin);
  laid.retraction = frames(stretch.whole.end - stretch.core.end);
  laid.aligned = options.alignment == Alignment::ground || (options.alignment == Alignment::automatic && !own);
  if (laid.aligned) {
    laid.transform = align(standing_over(stretch.motion, within(stretch, stretch.core)), home);
  }
  return laid;
}

std::string name_at_end(const Stretch& stretch) {
  return stretch.signs.empty() ? stretch.recording : stretch.signs.back().gloss;
}
std::string name_at_begin(const Stretch& stretch) {
  return stretch.signs.empty() ? stretch.recording : stretch.signs.front().gloss;
}

/// Appends poses to the result, with where each came from.
class Writer {
 public:
  explicit Writer(Synthesis& out) : out_(out) {}

  std::int64_t frame_count() const noexcept { return out_.motion.frame_count(); }

  void keep(const Laid& laid, std::size_t stretch, std::int64_t k, std::int32_t junction = FrameSource::kNone) {
    laid.pose_at(k, out_.motion.append());
    out_.sources.push_back({static_cast<std::int32_t>(stretch), junction, laid.frame_at(k)});
  }
  void crossfade(const Laid& a, std::int64_t ka, const Laid& b, std::int64_t kb, std::int64_t count,
                 std::size_t junction) {
    // Signs are kept along both sides, and chosen so that in the middle the shorter arc is taken: choosing it anew for
    // each frame would make a joint jump where the two sides pass half a turn apart.
    Pose pose_a(out_.motion.skeleton()), pose_b(out_.motion.skeleton());
    Pose last_a, last_b;
    const auto sample_both = [&](std::int64_t k) {
      a.pose_at(ka + k, pose_a.view());
      b.pose_at(kb + k, pose_b.view());
      if (!last_a.rotations.empty()) {
        follow_signs(last_a, pose_a);
        follow_signs(last_b, pose_b);
      }
      last_a = pose_a;
      last_b = pose_b;
    };
    for (std::int64_t k = 0; k <= count / 2; ++k) sample_both(k);
    for (std::size_t joint = 0; joint < pose_b.rotations.size(); ++joint) {
      if (pose_a.rotations[joint].dot(pose_b.rotations[joint]) < 0) last_b.rotations[joint].coeffs() *= -1.0f;
    }
    for (std::int64_t k = count / 2; k-- > 0;) sample_both(k);  // back to the first frame, with the signs of the middle
    for (std::int64_t k = 0; k < count; ++k) {
      sample_both(k);
      const float weight = crossfade_weight(k, count);
      const MutablePoseView pose = out_.motion.append();
      blend(pose_a.view(), pose_b.view(), weight, pose);  // the translations
      for (std::size_t joint = 0; joint < pose.rotations.size(); ++joint) {
        pose.rotations[joint] = slerp_as_signed(pose_a.rotations[joint], pose_b.rotations[joint], weight);
      }
      out_.sources.push_back({FrameSource::kNone, static_cast<std::int32_t>(junction), 0});
    }
  }
  void gap(const Border& from, const Border& to, std::int64_t index, std::int64_t count, double ease,
           std::size_t junction) {
    fill_gap(from, to, index, count, ease, out_.motion.append());
    out_.sources.push_back({FrameSource::kNone, static_cast<std::int32_t>(junction), 0});
  }

 private:
  static void follow_signs(const Pose& last, Pose& pose) {
    for (std::size_t joint = 0; joint < pose.rotations.size(); ++joint) {
      if (pose.rotations[joint].dot(last.rotations[joint]) < 0) pose.rotations[joint].coeffs() *= -1.0f;
    }
  }

  Synthesis& out_;
};

/// The transition between two stretches: Algorithm 1, lines 3 to 6.
void join(const Laid& a, const Laid& b, std::size_t index, const TransitionCut& cut, double hertz, Writer& writer,
          const Skeleton& skeleton) {
  const auto stretch = static_cast<std::int64_t>(index);
  const auto junction = static_cast<std::int32_t>(index);
  const std::int64_t end = a.core_frames;  // k of the first frame after a's core
  const std::int64_t overlap = cut.overlap();
  const std::int64_t gap = cut.gap();
  for (std::int64_t k = 0; k < cut.retraction_frames - overlap; ++k) {
    writer.keep(a, static_cast<std::size_t>(stretch), end + k, junction);
  }
  if (overlap > 0) {
    writer.crossfade(a, end + cut.retraction_frames - overlap, b, -cut.preparation_frames, overlap, index);
  }
  if (gap > 0) {
    Pose left(skeleton), left_context(skeleton), right(skeleton), right_context(skeleton);
    const std::int64_t last = end + cut.retraction_frames - 1;
    const std::int64_t first = -cut.preparation_frames;
    // The context may reach into the strokes: it is only looked at.
    const std::int64_t before = std::min(cut.blend_frames, last + a.preparation);
    const std::int64_t after = std::min(cut.blend_frames, b.core_frames + b.retraction - 1 - first);
    a.pose_at(last, left.view());
    a.pose_at(last - before, left_context.view());
    b.pose_at(first, right.view());
    b.pose_at(first + after, right_context.view());
    const Border from{left.view(), left_context.view(), before};
    const Border to{right.view(), right_context.view(), after};
    const double ease = kEaseSeconds * hertz;
    for (std::int64_t k = 0; k < gap; ++k) writer.gap(from, to, k, gap, ease, index);
  }
  for (std::int64_t k = -cut.preparation_frames + overlap; k < 0; ++k) {
    writer.keep(b, static_cast<std::size_t>(stretch) + 1, k, junction);
  }
}

Milliseconds time_of(std::int64_t frame, FrameRate rate) {
  return Milliseconds(std::llround(static_cast<double>(frame) * 1000.0 * static_cast<double>(rate.denominator) /
                                   static_cast<double>(rate.numerator)));
}

/// Where a stretch's signs may lie: between the middles of the transitions on both sides.
struct Room {
  TimeSpan span;
  TimeSpan kept;               ///< where the frames are those of the recording
  bool joined_before = false;  ///< a junction is there, not the begin of the result
  bool joined_after = false;
};

/// Places a stretch's signs in output time. At a junction its first sign begins, and its last ends, with the room.
void place_signs(const Stretch& stretch, const Placed& placed, std::size_t index, const Room& room, Synthesis& out) {
  const FrameRate rate = out.motion.rate();
  const auto output_time = [&](Milliseconds recorded) {
    const double frame = stretch.clock.frame_at(recorded);
    const double at = static_cast<double>(placed.core.begin) + (frame - placed.first_frame) / placed.step;
    const Milliseconds time(std::llround(at * 1000.0 / rate.hertz()));
    return std::clamp(time, room.span.begin, room.span.end);
  };
  for (std::size_t i = 0; i < stretch.signs.size(); ++i) {
    const Sign& source = stretch.signs[i];
    PlacedSign sign{.sign = source, .stretch = index, .recorded = source.span};
    const auto recorded_stroke = source.stroke_span();
    // Where the core begins or ends with the stroke. At a piece cut through a sign it does not: that sign stays as it
    // was.
    const auto meets = [&](Milliseconds recorded, std::int64_t frame) {
      return std::abs(stretch.clock.frame_at(recorded) - static_cast<double>(frame)) <= 1.0;
    };
    const bool first = i == 0 && recorded_stroke && meets(recorded_stroke->begin, stretch.core.begin);
    const bool last = i + 1 == stretch.signs.size() && recorded_stroke && meets(recorded_stroke->end, stretch.core.end);
    sign.sign.span = {first && room.joined_before ? room.span.begin : output_time(source.span.begin),
                      last && room.joined_after ? room.span.end : output_time(source.span.end)};
    std::vector<Phase> phases;
    if (!(first && room.joined_before) && !(last && room.joined_after)) {
      // Nothing of it was made: it stays as it was annotated, holds and all.
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
    // Preparation and retraction fill what was made; a hold that is kept in them stays a hold.
    const auto surround = [&](PhaseKind kind, const std::string& label, TimeSpan all) {
      Milliseconds from = all.begin;
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

}  // namespace

Synthesis concatenate(const std::vector<Stretch>& stretches, const ConcatenateOptions& options) {
  if (stretches.empty()) throw Error(ErrorCode::bad_input, "nothing to join");
  const Stretch& reference = stretches.at(options.reference);
  check_skeletons(stretches, reference);
  const TransitionMethod& method = options.method != nullptr ? *options.method : transition_methods().front();
  const FrameRate rate = options.rate.numerator > 0 ? options.rate : highest_rate(stretches);
  const Standing home = standing_over(reference.motion, within(reference, reference.core));

  std::vector<Laid> laid;
  for (const Stretch& stretch : stretches) {
    laid.push_back(lay(stretch, options, rate, home, stretch.recording == reference.recording));
  }
  std::vector<TransitionCut> cuts;
  std::int64_t total = laid.front().preparation + laid.back().retraction;
  for (std::size_t i = 0; i < laid.size(); ++i) {
    total += laid[i].core_frames;
    if (i + 1 == laid.size()) break;
    const Milliseconds pause = stretches[i + 1].pause_before;
    const double seconds = Seconds(options.duration + pause).count() / options.tempo;
    const TransitionRoom room{.length = std::max<std::int64_t>(1, std::llround(seconds * rate.hertz())),
                              .retraction = laid[i].retraction,
                              .preparation = laid[i + 1].preparation,
                              .frames_per_second = rate.hertz(),
                              .pause = pause > Milliseconds(0)};
    cuts.push_back(method.cut(room));
    total += cuts.back().length;
  }

  Synthesis out;
  out.motion = Motion(reference.motion.shared_skeleton(), rate);
  out.motion.reserve(total);
  out.sources.reserve(static_cast<std::size_t>(total));
  Writer writer(out);
  for (std::int64_t k = -laid.front().preparation; k < 0; ++k) writer.keep(laid.front(), 0, k);
  for (std::size_t i = 0; i < laid.size(); ++i) {
    Placed placed{.recording = stretches[i].recording, .first_frame = laid[i].frame_at(0), .step = laid[i].step};
    placed.core.begin = writer.frame_count();
    for (std::int64_t k = 0; k < laid[i].core_frames; ++k) writer.keep(laid[i], i, k);
    placed.core.end = writer.frame_count();
    placed.output = placed.core;
    out.stretches.push_back(placed);
    if (i + 1 == laid.size()) break;
    const std::int64_t begin = writer.frame_count();
    join(laid[i], laid[i + 1], i, cuts[i], rate.hertz(), writer, out.motion.skeleton());
    out.junctions.push_back({.from = name_at_end(stretches[i]),
                             .to = name_at_begin(stretches[i + 1]),
                             .frames = {begin, writer.frame_count()},
                             .cut = cuts[i],
                             .method = std::string(method.name)});
    assert(out.junctions.back().frames.size() == cuts[i].length);
  }
  for (std::int64_t k = 0; k < laid.back().retraction; ++k)
    writer.keep(laid.back(), laid.size() - 1, laid.back().core_frames + k);
  out.stretches.front().output.begin = 0;
  out.stretches.back().output.end = writer.frame_count();
  keep_hemisphere(out.motion);

  for (std::size_t i = 0; i < stretches.size(); ++i) {
    // The middle of what was made between two signs parts them.
    const auto middle = [&](std::size_t junction) {
      const Junction& one = out.junctions[junction];
      const std::int64_t kept = one.cut.retraction_frames - one.cut.overlap();
      return time_of(one.frames.begin + kept + (one.cut.overlap() + one.cut.gap()) / 2, rate);
    };
    const bool last = i + 1 == stretches.size();
    const TimeSpan span{i == 0 ? Milliseconds(0) : middle(i - 1),
                        last ? time_of(writer.frame_count(), rate) : middle(i)};
    TimeSpan kept = span;
    if (i > 0) {
      const Junction& before = out.junctions[i - 1];
      kept.begin = time_of(before.frames.end - before.cut.preparation_frames + before.cut.overlap(), rate);
    }
    if (!last) {
      const Junction& after = out.junctions[i];
      kept.end = time_of(after.frames.begin + after.cut.retraction_frames - after.cut.overlap(), rate);
    }
    place_signs(stretches[i], out.stretches[i], i, {span, kept, i > 0, !last}, out);
  }
  return out;
}

}  // namespace signweave
