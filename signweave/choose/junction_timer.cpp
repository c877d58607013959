#include "signweave/choose/junction_timer.h"

#include <algorithm>
#include <cmath>

#include "signweave/transition/duration.h"

namespace signweave {
namespace {

/// Maximum kept part of a retraction or preparation with a chosen cut.
constexpr Seconds kLongestKept{1.5};

std::int64_t frames_in(Seconds time, FrameRate rate) {
  return std::llround(time.count() * rate.hertz());
}

/// `frames` are counted from the first frame of the core.
void read(const JunctionSettings& settings, const PlacedClip& placed, FrameRange frames, Motion& out) {
  PlacedClip alone = placed;
  alone.core = 0;
  out.reset(settings.skeleton, settings.rate, frames.size());
  read_frames(alone, frames, out.poses({0, frames.size()}));
}

/// The frames around two cuts.
struct Sides {
  CutSide from, to;
};

/// The same before the cuts are known: at most `most` frames next to each stroke, and kContext of the strokes.
Sides read(const JunctionSettings& settings, const PlacedClip& a, const PlacedClip& b, std::int64_t most,
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

JunctionTimer::JunctionTimer(const JunctionSettings& settings, const TransitionTiming& timing)
    : settings_(settings), timing_(timing) {
  if (settings.method->cut == nullptr) chooser_.emplace(*settings.skeleton, settings.rig->groups);
}

JunctionCuts JunctionTimer::cuts_between(const PlacedClip& a, const PlacedClip& b, Milliseconds pause,
                                         JunctionScratch& scratch, std::optional<std::int64_t> length) {
  const JunctionChoice& own = b.captured->junction;
  const auto cut = method_of(settings_, b).cut;
  const bool choose = cut == nullptr;
  if (choose && !chooser_) chooser_.emplace(*settings_.skeleton, settings_.rig->groups);
  const bool fitted = !length && !own.duration && timing_.fit != nullptr && !timing_.fit->weights.empty();
  Seconds duration = own.duration             ? Seconds(*own.duration)
                     : timing_.fit != nullptr ? timing_.fit->mean
                                              : Seconds(timing_.duration);
  Sides sides;
  if (choose || fitted) {
    sides = read(settings_, a, b, choose ? frames_in(kLongestKept, settings_.rate) : 0, scratch);
  }
  if (fitted) {
    // The whole transition as a gap, with nothing kept.
    const Gap whole{.skeleton = settings_.skeleton.get(),
                    .groups = &settings_.rig->groups,
                    .rate = settings_.rate,
                    .before = view_of(scratch.left, {0, sides.from.stroke + 1}),
                    .after = view_of(scratch.right, {sides.to.stroke, scratch.right.frame_count()}),
                    .count = 1};
    TransitionTask task = task_of(whole, settings_.rig->signer);
    for (HandTask& hand : task.hands) {  // as at tempo 1
      const auto tempo = static_cast<float>(timing_.tempo);
      hand.speed_before /= tempo;
      hand.speed_after /= tempo;
      hand.approach /= tempo;
    }
    duration = duration_of(*timing_.fit, task);
  }
  const double seconds = (duration / own.tempo.value_or(1.0) + Seconds(pause)).count() / timing_.tempo;
  const double hertz = settings_.rate.hertz();
  const TransitionRoom room{.length = std::max<std::int64_t>(1, length.value_or(std::llround(seconds * hertz))),
                            .retraction = a.retraction,
                            .preparation = b.preparation,
                            .frames_per_second = hertz,
                            .pause = pause > Milliseconds(0),
                            .pause_frames = std::llround(Seconds(pause).count() / timing_.tempo * hertz)};
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

void place_after(PlacedClip& a, PlacedClip& b, const JunctionCuts& cuts) {
  for (const TransitionCut& cut : cuts.parts) {
    a.after = std::max(a.after, cut.retraction_frames);
    b.before = std::max(b.before, cut.preparation_frames);
  }
  b.core = a.core_end() + cuts.tracks.length;
}

}  // namespace signweave
