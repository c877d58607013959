#include "signweave/render/render.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "signweave/motion/blend.h"
#include "signweave/render/carry_tracks.h"
#include "signweave/score/place_signs.h"

namespace signweave {
namespace {

const std::string& name_at_end(const Stretch& stretch) {
  return stretch.signs.empty() ? stretch.recording : stretch.signs.back().gloss;
}
const std::string& name_at_begin(const Stretch& stretch) {
  return stretch.signs.empty() ? stretch.recording : stretch.signs.front().gloss;
}

/// Output frames of a stretch that the one before has not.
FrameRange own_frames(const Plan& plan, std::size_t i) {
  const Laid& now = plan.laid[i];
  return {now.begin() + (i == 0 ? 0 : JunctionFiller::shared(plan.laid[i - 1], now)), now.end()};
}

/// Brings the fetched frames of the stretches to where they stand, one after the other, and fills what lies between
/// them.
class Filler {
 public:
  Filler(const Plan& plan, const JunctionSettings& settings, Synthesis& out)
      : plan_(plan), junctions_(settings), out_(out) {}

  /// Stretch i, and the transition before it.
  void fill(std::size_t i) {
    const Laid& now = plan_.laid[i];
    const FrameRange own = own_frames(plan_, i);
    const std::int64_t shared = own.begin - now.begin();
    scratch_.shared.reset(out_.motion.shared_skeleton(), out_.motion.rate(), shared);
    read_frames(now, {now.begin(), own.begin}, scratch_.shared.poses({0, shared}));
    align(i, own);
    if (i > 0) junctions_.fill(plan_.laid[i - 1], now, plan_.cuts[i - 1].parts, {out_.motion}, scratch_);
    tell_sources(i);
  }

 private:
  void align(std::size_t i, FrameRange own) {
    const std::optional<GroundTransform>& standing = plan_.standing[i];
    if (!standing) return;
    for (std::int64_t k = 0; k < scratch_.shared.frame_count(); ++k)
      apply(*standing, out_.motion.skeleton(), scratch_.shared.pose(k));
    for (std::int64_t frame = own.begin; frame < own.end; ++frame)
      apply(*standing, out_.motion.skeleton(), out_.motion.pose(frame));
  }

  void tell_sources(std::size_t i) {
    const Laid& now = plan_.laid[i];
    const auto stretch = static_cast<std::int32_t>(i);
    const bool last = i + 1 == plan_.laid.size();
    const std::int64_t kept_before = i == 0 ? now.before : common_to(plan_.cuts[i - 1].parts).kept_before();
    const std::int64_t kept_after = last ? now.after : common_to(plan_.cuts[i].parts).kept_after();
    const auto at = [&](std::int64_t frame) -> FrameSource& { return out_.sources[static_cast<std::size_t>(frame)]; };
    if (i > 0) {
      const std::int64_t made_from = plan_.laid[i - 1].core_end() + common_to(plan_.cuts[i - 1].parts).kept_after();
      for (std::int64_t frame = made_from; frame < now.core - kept_before; ++frame) {
        at(frame) = {FrameSource::kNone, stretch - 1, 0};
      }
    }
    const auto kept = [&](std::int64_t begin, std::int64_t end, std::int32_t junction) {
      if (now.captured_as_is()) {
        const std::int64_t shift = now.stretch->core.begin - now.core;
        for (std::int64_t frame = begin; frame < end; ++frame) {
          at(frame) = {stretch, junction, static_cast<double>(frame + shift)};
        }
      } else {
        for (std::int64_t frame = begin; frame < end; ++frame) at(frame) = {stretch, junction, now.frame_at(frame)};
      }
    };
    kept(now.core - kept_before, now.core, i > 0 ? stretch - 1 : FrameSource::kNone);
    kept(now.core, now.core_end(), FrameSource::kNone);
    kept(now.core_end(), now.core_end() + kept_after, last ? FrameSource::kNone : stretch);
  }

  const Plan& plan_;
  JunctionFiller junctions_;
  Synthesis& out_;
  JunctionScratch scratch_;
};

void render_plan(const Plan& plan, const JunctionSettings& settings, std::vector<ScalarTrack> used_tracks,
                 Synthesis& out) {
  out.sources.resize(static_cast<std::size_t>(plan.frames));
  Filler filler(plan, settings, out);
  for (std::size_t i = 0; i < plan.laid.size(); ++i) filler.fill(i);
  out.stretches.clear();
  out.junctions.clear();

  for (std::size_t i = 0; i < plan.laid.size(); ++i) {
    const Laid& laid = plan.laid[i];
    const Stretch& stretch = *laid.stretch;
    const FrameRange core{laid.core, laid.core_end()};
    out.stretches.push_back({.recording = stretch.recording,
                             .output = {i == 0 ? 0 : core.begin, i + 1 == plan.laid.size() ? plan.frames : core.end},
                             .core = core,
                             .first_frame = laid.frame_at(core.begin),
                             .step = laid.step});
    if (i == 0) continue;
    out.junctions.push_back({.from = name_at_end(*plan.laid[i - 1].stretch),
                             .to = name_at_begin(stretch),
                             .frames = {plan.laid[i - 1].core_end(), laid.core},
                             .cut = common_to(plan.cuts[i - 1].parts),
                             .cuts = plan.cuts[i - 1].parts,
                             .method = std::string(method_of(settings, plan.laid[i]).name),
                             .number = i,
                             .chosen = stretch.junction});
    assert(out.junctions.back().frames.size() == plan.cuts[i - 1].tracks.length);
  }
  std::vector<Laid> laid_tracks = plan.laid;
  for (std::size_t i = 0; i < plan.cuts.size(); ++i) {
    laid_tracks[i].after = plan.cuts[i].tracks.retraction_frames;
    laid_tracks[i + 1].before = plan.cuts[i].tracks.preparation_frames;
  }
  carry_tracks(laid_tracks, std::move(used_tracks), out.motion);
}

}  // namespace

std::vector<ScalarTrack> fetch(const Plan& plan, const JunctionSettings& settings, Motion& out) {
  std::vector<ScalarTrack> used_tracks = out.take_tracks();
  out.reset(settings.skeleton, settings.rate, plan.frames);
  for (std::size_t i = 0; i < plan.laid.size(); ++i) {
    const FrameRange own = own_frames(plan, i);
    read_frames(plan.laid[i], own, out.poses(own));
  }
  return used_tracks;
}

void render(Score score, const std::vector<Stretch>& stretches, const JunctionSettings& settings, Synthesis& out,
            std::optional<std::vector<ScalarTrack>> fetched) {
  const Plan plan = plan_of(score, stretches);
  if (!fetched) fetched = fetch(plan, settings, out.motion);
  render_plan(plan, settings, std::move(*fetched), out);
  for (std::size_t i = 0; i < out.junctions.size(); ++i) {
    const JunctionRef& junction = score.junctions[i];
    out.junctions[i].number = junction.number;
    out.junctions[i].chosen =
        junction.chosen.empty() ? JunctionChoice() : parse_junction("1=" + junction.chosen).choice;
  }
  place_signs(stretches, out);
  out.score = std::move(score);
}

}  // namespace signweave
