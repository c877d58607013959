#include "signweave/synthesis/junction.h"

#include <algorithm>
#include <cmath>

#include "signweave/motion/blend.h"
#include "signweave/transition/duration.h"

namespace signweave {
namespace {

/// No more is kept of a retraction or a preparation where the cut is chosen.
constexpr Seconds kLongestKept{1.5};

std::int64_t frames_in(Seconds time, FrameRate rate) {
  return std::llround(time.count() * rate.hertz());
}

/// Frames counted from the core's first.
void read(const JunctionSettings& settings, const Laid& laid, FrameRange frames, Motion& out) {
  Laid alone = laid;
  alone.core = 0;
  out.reset(settings.skeleton, settings.rate, frames.size());
  read_frames(alone, frames, out.poses({0, frames.size()}));
}

/// What lies around two cuts.
struct Sides {
  CutSide from, to;
};

/// The same, before it is known where the cuts come to lie: at most `most` frames beside each stroke, and kContext of
/// the strokes themselves.
Sides read(const JunctionSettings& settings, const Laid& a, const Laid& b, std::int64_t most,
           JunctionScratch& scratch) {
  const std::int64_t context = std::max<std::int64_t>(1, frames_in(kContext, settings.rate));
  const std::int64_t within_a = std::min(context, a.core_frames);
  const std::int64_t within_b = std::min(context, b.core_frames);
  const std::int64_t before = std::min(b.preparation, most);
  read(settings, a, {a.core_frames - within_a, a.core_frames + std::min(a.retraction, most)}, scratch.left);
  read(settings, b, {-before, within_b}, scratch.right);
  return {.from = {view_of(scratch.left, {0, scratch.left.frame_count()}), within_a - 1},
          .to = {view_of(scratch.right, {0, scratch.right.frame_count()}), before}};
}

}  // namespace

const TransitionMethod& method_of(const JunctionSettings& settings, const Laid& laid) noexcept {
  const TransitionMethod* const own = laid.stretch->junction.method;
  return own != nullptr ? *own : *settings.method;
}

JunctionTimer::JunctionTimer(const JunctionSettings& settings) : settings_(settings) {
  if (settings.method->cut == nullptr) chooser_.emplace(*settings.skeleton, settings.rig->groups);
}

JunctionCuts JunctionTimer::cuts_between(const Laid& a, const Laid& b, Milliseconds pause, JunctionScratch& scratch) {
  const JunctionChoice& own = b.stretch->junction;
  const auto cut = method_of(settings_, b).cut;
  const bool choose = cut == nullptr;
  if (choose && !chooser_) chooser_.emplace(*settings_.skeleton, settings_.rig->groups);
  const bool fitted = !own.duration && settings_.fit != nullptr && !settings_.fit->weights.empty();
  Seconds duration = own.duration               ? Seconds(*own.duration)
                     : settings_.fit != nullptr ? settings_.fit->mean
                                                : Seconds(settings_.duration);
  Sides sides;
  if (choose || fitted) {
    sides = read(settings_, a, b, choose ? frames_in(kLongestKept, settings_.rate) : 0, scratch);
  }
  if (fitted) {
    // The transition as it is where nothing of it is kept.
    const Gap whole{.skeleton = settings_.skeleton.get(),
                    .groups = &settings_.rig->groups,
                    .rate = settings_.rate,
                    .before = view_of(scratch.left, {0, sides.from.stroke + 1}),
                    .after = view_of(scratch.right, {sides.to.stroke, scratch.right.frame_count()}),
                    .count = 1};
    TransitionTask task = task_of(whole, settings_.rig->signer);
    for (HandTask& hand : task.hands) {  // as at tempo 1
      const auto tempo = static_cast<float>(settings_.tempo);
      hand.speed_before /= tempo;
      hand.speed_after /= tempo;
      hand.approach /= tempo;
    }
    duration = duration_of(*settings_.fit, task);
  }
  const double seconds = (duration / own.tempo.value_or(1.0) + Seconds(pause)).count() / settings_.tempo;
  const double hertz = settings_.rate.hertz();
  const TransitionRoom room{.length = std::max<std::int64_t>(1, std::llround(seconds * hertz)),
                            .retraction = a.retraction,
                            .preparation = b.preparation,
                            .frames_per_second = hertz,
                            .pause = pause > Milliseconds(0),
                            .pause_frames = std::llround(Seconds(pause).count() / settings_.tempo * hertz)};
  JunctionCuts cuts{.parts = {}, .tracks = choose ? cut_with_gap(room) : cut(room)};
  if (!choose) {
    cuts.parts.fill(cuts.tracks);
    return cuts;
  }
  TransitionRoom known = room;  // what was read
  known.retraction = sides.from.frames.frames - 1 - sides.from.stroke;
  known.preparation = sides.to.stroke;
  cuts.parts = chooser_->choose(known, sides.from, sides.to);
  return cuts;
}

void lay_after(Laid& a, Laid& b, const JunctionCuts& cuts) {
  for (const TransitionCut& cut : cuts.parts) {
    a.after = std::max(a.after, cut.retraction_frames);
    b.before = std::max(b.before, cut.preparation_frames);
  }
  b.core = a.core_end() + cuts.tracks.length;
}

JunctionFiller::JunctionFiller(const JunctionSettings& settings)
    : settings_(settings), guard_(*settings_.skeleton, settings_.rig->signer, settings_.rig->groups) {}

std::int64_t JunctionFiller::shared(const Laid& a, const Laid& b) noexcept {
  return std::max<std::int64_t>(0, a.end() - b.begin());
}

std::int64_t JunctionFiller::context() const noexcept {
  return std::max<std::int64_t>(1, frames_in(kContext, settings_.rate));
}

void JunctionFiller::fill(const Laid& a, const Laid& b, const TransitionCuts& cuts, OutputWindow window,
                          JunctionScratch& scratch) {
  Motion& shared = scratch.shared;
  const bool as_one = std::ranges::all_of(cuts, [&](const TransitionCut& cut) { return cut == cuts.front(); });
  turn_signs(a, b, cuts, window, shared);
  if (cuts.front().overlap() > 0) {
    crossfade(b, cuts.front().overlap(), window, shared);
  } else if (shared.frame_count() > 0) {
    take_over(b, cuts, window, shared);
  }
  // The body first: where it is, the arms' frames are those of whole poses.
  for (std::size_t part = 0; part < (as_one ? 1 : kTimed); ++part) {
    const FrameRange gap{a.core_end() + cuts[part].retraction_frames, b.core - cuts[part].preparation_frames};
    if (gap.empty()) continue;
    fill_gap(a, b, gap, as_one ? GroupSet::all() : groups_of(kAllTimed[part]), cuts[part], window, scratch.gap);
  }
  for (const Timed part : {Timed::left, Timed::right}) {
    const TransitionCut& cut = cuts[static_cast<std::size_t>(part)];
    const FrameRange made{a.core_end() + cut.kept_after(), b.core - cut.kept_before()};
    if (!made.empty()) guard_.mend(gap_at(a, b, made, window), groups_of(part), window.poses(made));
  }
}

/// Each stretch keeps its quaternions' signs from frame to frame, so one sign a joint makes the whole of it go on from
/// the side before. It is chosen where the two meet: in the middle of a cross-fade, so that there the shorter arc is
/// taken. Choosing anew for each frame would make a joint jump where the sides pass half a turn apart.
void JunctionFiller::turn_signs(const Laid& a, const Laid& b, const TransitionCuts& cuts, OutputWindow window,
                                Motion& shared) const {
  const std::int64_t faded = cuts.front().overlap();
  const std::int64_t own_begin = b.begin() + shared.frame_count();
  const std::int64_t own_end = std::min(b.end(), window.frames().end);
  const auto right_pose = [&](std::int64_t frame) {
    return frame < own_begin ? PoseView(shared.pose(frame - b.begin())) : PoseView(window.pose(frame));
  };
  const JointGroups& groups = settings_.rig->groups;
  for (std::size_t part = 0; part < kTimed; ++part) {
    const TransitionCut& cut = cuts[part];
    const std::int64_t begin = b.core - cut.preparation_frames;
    const PoseView left = window.pose(faded > 0 ? begin + faded / 2 : a.core_end() + cut.retraction_frames - 1);
    const PoseView right = right_pose(faded > 0 ? begin + faded / 2 : begin);
    const GroupSet of_part = groups_of(kAllTimed[part]);
    for (std::size_t joint = 0; joint < left.rotations.size(); ++joint) {
      if (!of_part.has(groups.of[joint]) || left.rotations[joint].dot(right.rotations[joint]) >= 0) continue;
      for (std::int64_t k = 0; k < shared.frame_count(); ++k) shared.pose(k).rotations[joint].coeffs() *= -1.0f;
      for (std::int64_t frame = own_begin; frame < own_end; ++frame) {
        window.pose(frame).rotations[joint].coeffs() *= -1.0f;
      }
    }
  }
}

void JunctionFiller::crossfade(const Laid& b, std::int64_t frames, OutputWindow window, const Motion& shared) const {
  for (std::int64_t k = 0; k < frames; ++k) {
    const MutablePoseView pose = window.pose(b.begin() + k);
    const PoseView other = shared.pose(k);
    const float weight = crossfade_weight(k, frames);
    slerp_as_signed(pose.rotations, other.rotations, weight, pose.rotations);
    for (std::size_t t = 0; t < pose.translations.size(); ++t) {
      pose.translations[t] += weight * (other.translations[t] - pose.translations[t]);
    }
  }
}

/// Where one part still shows the side before and another already this one.
void JunctionFiller::take_over(const Laid& b, const TransitionCuts& cuts, OutputWindow window,
                               const Motion& shared) const {
  const JointGroups& groups = settings_.rig->groups;
  for (std::int64_t k = 0; k < shared.frame_count(); ++k) {
    const std::int64_t frame = b.begin() + k;
    const auto has_begun = [&](JointGroup group) {
      return frame >= b.core - cuts[static_cast<std::size_t>(timed_of(group))].preparation_frames;
    };
    const MutablePoseView pose = window.pose(frame);
    const PoseView other = shared.pose(k);
    for (std::size_t joint = 0; joint < pose.rotations.size(); ++joint) {
      if (has_begun(groups.of[joint])) pose.rotations[joint] = other.rotations[joint];
    }
    for (std::size_t t = 0; t < pose.translations.size(); ++t) {
      if (has_begun(groups.of_translation[t])) pose.translations[t] = other.translations[t];
    }
  }
}

/// The context reaches into the strokes, where it is only looked at, and no farther: what follows a stroke need not be
/// known yet.
Gap JunctionFiller::gap_at(const Laid& a, const Laid& b, FrameRange frames, OutputWindow window) const {
  return {.skeleton = settings_.skeleton.get(),
          .groups = &settings_.rig->groups,
          .rate = settings_.rate,
          .before = window.view({std::max(a.core, frames.begin - context()), frames.begin}),
          .after = window.view({frames.end, std::min(frames.end + context(), b.core_end())}),
          .count = frames.size(),
          .noise_before = a.stretch->noise.get(),
          .noise_after = b.stretch->noise.get()};
}

void JunctionFiller::fill_gap(const Laid& a, const Laid& b, FrameRange frames, GroupSet groups,
                              const TransitionCut& cut, OutputWindow window, GapScratch& scratch) const {
  static const GapMethod* const waiting =
      find_gap_method("sine");  // from rest to rest, whatever noise the borders have
  Gap gap = gap_at(a, b, frames, window);
  gap.pause = static_cast<double>(cut.pause_frames) * gap.rate.frame_time();
  const GapMethod& method = cut.waits ? *waiting : *method_of(settings_, b).fill;
  const TransitionModel& model = settings_.model != nullptr ? *settings_.model : default_transition_model();
  method.fill({.gap = gap, .model = model, .groups = groups, .scratch = scratch}, window.poses(frames));
}

}  // namespace signweave
