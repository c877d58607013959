#include "signweave/live/weaver.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "signweave/choose/on_skeleton.h"
#include "signweave/core/error.h"
#include "signweave/render/carry_tracks.h"
#include "signweave/render/window.h"

namespace signweave {
namespace {

/// Memory of a thread for the junctions that it makes, whosever they are: it is large, and needed for a moment only.
struct WeavingScratch {
  JunctionScratch junction;
  Motion window, core;
  std::vector<ScalarTrack> tracks;
};
constexpr std::int64_t kKeptFrames = 2'048;  ///< what takes more memory gives it back
WeavingScratch& scratch() {
  thread_local WeavingScratch kept;
  return kept;
}

Standing standing_of_sign(const Laid& laid, const JunctionSettings& settings) {
  Motion& core = scratch().core;
  const Standing standing = standing_of(laid, settings, core);
  if (core.frame_count() > kKeptFrames) core = Motion();
  return standing;
}

}  // namespace

Weaver::Weaver(const JunctionSettings& settings, const TransitionTiming& timing, std::vector<std::string> tracks,
               Alignment alignment, const Stretch& home)
    : settings_(settings),
      tempo_(timing.tempo),
      tracks_(std::move(tracks)),
      alignment_(alignment),
      home_recording_(home.recording),
      timer_(settings, timing),
      filler_(settings) {
  home_ = standing_of_sign(lay(home, settings_.rate, tempo_), settings_);
}

void Weaver::lay_sign(Woven& woven) const {
  require_same_joints(home_recording_, settings_.skeleton, woven.stretch);
  woven.laid = lay(woven.stretch, settings_.rate, tempo_);
  woven.aligned = is_aligned(alignment_, woven.stretch.recording, home_recording_);
  woven.laid.standing.reset();
  woven.track_of.clear();
  for (const std::string& name : woven.stretch.source->tracks()) {
    const auto at = std::ranges::find(tracks_, name);
    woven.track_of.push_back(at == tracks_.end() ? Woven::kNoTrack : static_cast<std::size_t>(at - tracks_.begin()));
  }
}

void Weaver::lay_frames(Woven& woven) const {
  lay_sign(woven);
  woven.laid = lay(woven.stretch, settings_.rate, 1.0);
  woven.aligned = false;
}

void Weaver::place(Woven& woven) {
  if (!woven.aligned || woven.laid.standing) return;
  woven.laid.standing = align(standing_of_sign(woven.laid, settings_), home_);
}

JunctionCuts Weaver::join(Woven& a, Woven& b, Motion& made) {
  WeavingScratch& memory = scratch();
  const JunctionCuts cuts = timer_.cuts_between(a.laid, b.laid, b.stretch.pause_before, memory.junction);
  if (cuts.tracks.length > kMostMade) {
    throw Error(ErrorCode::bad_input,
                fmt::format("a transition of {} frames is longer than {}; ask for a lower rate or a shorter duration",
                            cuts.tracks.length, kMostMade));
  }
  a.laid.after = 0;
  b.laid.before = 0;
  lay_after(a.laid, b.laid, cuts);
  b.cuts = cuts;
  place(b);
  const std::int64_t context = filler_.context();
  const FrameRange frames{std::max(a.laid.core, a.laid.core_end() - context),
                          std::min(b.laid.core + context, b.laid.core_end())};
  memory.window.reset(settings_.skeleton, settings_.rate, frames.size());
  const OutputWindow window{memory.window, frames.begin};
  std::array laid = {a.laid, b.laid};
  fetch(laid, window);
  signweave::join({.clips = laid, .cuts = {&cuts, 1}}, filler_, window, memory.junction);

  const FrameRange between{a.laid.core_end(), b.laid.core};
  made.reset(settings_.skeleton, settings_.rate, between.size());
  const MutablePoses from = window.poses(between);
  const MutablePoses to = made.poses({0, between.size()});
  std::ranges::copy(from.rotations, to.rotations.begin());
  std::ranges::copy(from.translations, to.translations.begin());
  if (!tracks_.empty()) {
    laid[0].after = cuts.tracks.retraction_frames;
    laid[1].before = cuts.tracks.preparation_frames;
    memory.tracks.resize(tracks_.size());
    for (std::size_t i = 0; i < tracks_.size(); ++i) memory.tracks[i].name = tracks_[i];
    carry_tracks(laid, frames, memory.tracks);
    for (const ScalarTrack& track : memory.tracks) {
      const float* const values = track.values.data() + (between.begin - frames.begin);
      made.add_track({track.name, std::vector<float>(values, values + between.size())});
    }
  }
  if (frames.size() > kKeptFrames) memory.window = Motion();
  return cuts;
}

void Weaver::read(const Woven& woven, FrameRange frames, MutablePoses out,
                  std::span<const std::span<float>> tracks) const {
  read_standing(woven.laid, *settings_.skeleton, frames, out);
  if (tracks.empty() || frames.empty()) return;
  for (const std::span<float> track : tracks) std::ranges::fill(track, 0.0f);
  std::vector<std::span<float>> of_source;
  of_source.reserve(woven.track_of.size());
  for (const std::size_t track : woven.track_of) {
    of_source.push_back(track == Woven::kNoTrack ? std::span<float>() : tracks[track]);
  }
  read_tracks(woven.laid, frames, of_source);
}

}  // namespace signweave
