#include "signweave/live/transition_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "signweave/choose/on_skeleton.h"
#include "signweave/core/error.h"
#include "signweave/render/carry_tracks.h"
#include "signweave/render/window.h"

namespace signweave {
namespace {

/// Per-thread memory for making junctions, shared by all builders, because it is large and needed only briefly.
struct BuilderScratch {
  JunctionScratch junction;
  Motion window, core;
  std::vector<ScalarTrack> tracks;
};
constexpr std::int64_t kKeptFrames = 2'048;  ///< longer buffers are freed after use
BuilderScratch& scratch() {
  thread_local BuilderScratch kept;
  return kept;
}

Standing standing_of_sign(const PlacedClip& placed, const JunctionSettings& settings) {
  Motion& core = scratch().core;
  const Standing standing = standing_of(placed, settings, core);
  if (core.frame_count() > kKeptFrames) core = Motion();
  return standing;
}

}  // namespace

TransitionBuilder::TransitionBuilder(const JunctionSettings& settings, const TransitionTiming& timing,
                                     std::vector<std::string> tracks, Alignment alignment, const MotionClip& home)
    : settings_(settings),
      tempo_(timing.tempo),
      tracks_(std::move(tracks)),
      alignment_(alignment),
      home_recording_(home.recording),
      timer_(settings, timing),
      filler_(settings) {
  home_ = standing_of_sign(placed_at_tempo(home, settings_.rate, tempo_), settings_);
}

void TransitionBuilder::place_sign(LiveClip& clip) const {
  require_same_joints(home_recording_, settings_.skeleton, clip.captured);
  clip.placed = placed_at_tempo(clip.captured, settings_.rate, tempo_);
  clip.aligned = is_aligned(alignment_, clip.captured.recording, home_recording_);
  clip.placed.standing.reset();
  clip.track_of.clear();
  for (const std::string& name : clip.captured.source->tracks()) {
    const auto at = std::ranges::find(tracks_, name);
    clip.track_of.push_back(at == tracks_.end() ? LiveClip::kNoTrack : static_cast<std::size_t>(at - tracks_.begin()));
  }
}

void TransitionBuilder::place_frames(LiveClip& clip) const {
  place_sign(clip);
  clip.placed = placed_at_tempo(clip.captured, settings_.rate, 1.0);
  clip.aligned = false;
}

void TransitionBuilder::place_first(LiveClip& clip) {
  if (!clip.aligned || clip.placed.standing) return;
  clip.placed.standing = align(standing_of_sign(clip.placed, settings_), home_);
}

JunctionCuts TransitionBuilder::join(LiveClip& a, LiveClip& b, Motion& made) {
  BuilderScratch& memory = scratch();
  const JunctionCuts cuts = timer_.cuts_between(a.placed, b.placed, b.captured.pause_before, memory.junction);
  if (cuts.tracks.length > kMostMade) {
    throw Error(ErrorCode::bad_input,
                fmt::format("a transition of {} frames is longer than {}; ask for a lower rate or a shorter duration",
                            cuts.tracks.length, kMostMade));
  }
  a.placed.after = 0;
  b.placed.before = 0;
  place_after(a.placed, b.placed, cuts);
  b.cuts = cuts;
  place_first(b);
  const std::int64_t context = filler_.context();
  const FrameRange frames{std::max(a.placed.core, a.placed.core_end() - context),
                          std::min(b.placed.core + context, b.placed.core_end())};
  memory.window.reset(settings_.skeleton, settings_.rate, frames.size());
  const OutputWindow window{memory.window, frames.begin};
  std::array placed = {a.placed, b.placed};
  fetch(placed, window);
  signweave::join({.clips = placed, .cuts = {&cuts, 1}}, filler_, window, memory.junction);

  const FrameRange between{a.placed.core_end(), b.placed.core};
  made.reset(settings_.skeleton, settings_.rate, between.size());
  const MutablePoses from = window.poses(between);
  const MutablePoses to = made.poses({0, between.size()});
  std::ranges::copy(from.rotations, to.rotations.begin());
  std::ranges::copy(from.translations, to.translations.begin());
  if (!tracks_.empty()) {
    placed[0].after = cuts.tracks.retraction_frames;
    placed[1].before = cuts.tracks.preparation_frames;
    memory.tracks.resize(tracks_.size());
    for (std::size_t i = 0; i < tracks_.size(); ++i) memory.tracks[i].name = tracks_[i];
    carry_tracks(placed, frames, memory.tracks);
    for (const ScalarTrack& track : memory.tracks) {
      const float* const values = track.values.data() + (between.begin - frames.begin);
      made.add_track({track.name, std::vector<float>(values, values + between.size())});
    }
  }
  if (frames.size() > kKeptFrames) memory.window = Motion();
  return cuts;
}

void TransitionBuilder::read(const LiveClip& clip, FrameRange frames, MutablePoses out,
                             std::span<const std::span<float>> tracks) const {
  read_standing(clip.placed, *settings_.skeleton, frames, out);
  if (tracks.empty() || frames.empty()) return;
  for (const std::span<float> track : tracks) std::ranges::fill(track, 0.0f);
  std::vector<std::span<float>> of_source;
  of_source.reserve(clip.track_of.size());
  for (const std::size_t track : clip.track_of) {
    of_source.push_back(track == LiveClip::kNoTrack ? std::span<float>() : tracks[track]);
  }
  read_tracks(clip.placed, frames, of_source);
}

}  // namespace signweave
