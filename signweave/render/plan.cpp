#include "signweave/render/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/core/error.h"
#include "signweave/render/held_clip.h"
#include "signweave/score/lane_chain.h"

namespace signweave {
namespace {

Channel channel_of(Timed part) noexcept {
  switch (part) {
    case Timed::body:
      return Channel::body;
    case Timed::left:
      return Channel::left;
    case Timed::right:
      return Channel::right;
  }
  return Channel::body;
}

/// Builds a lane; each transition begins after the kept retraction frames of its cut.
Lane lane_of(const Plan& plan, Channel channel, const auto& cut_of_junction) {
  Lane lane{.channel = channel, .items = {}};
  std::int64_t begin = 0;
  for (std::size_t i = 0; i < plan.placed.size(); ++i) {
    const PlacedClip& placed = plan.placed[i];
    const auto id = static_cast<ClipId>(i);
    if (i + 1 == plan.placed.size()) {
      lane.items.push_back({ClipUse{id}, {begin, plan.frames}});
      break;
    }
    const TransitionCut& cut = cut_of_junction(i);
    const std::int64_t end = placed.core_end() + cut.kept_after();
    const std::int64_t next = plan.placed[i + 1].core - cut.kept_before();
    lane.items.push_back({ClipUse{id}, {begin, end}});
    lane.items.push_back({Transition{id, id + 1, cut}, {end, next}});
    begin = next;
  }
  return lane;
}

std::vector<Lane> lanes_of(const Plan& plan) {
  std::vector<Lane> lanes;
  for (const Channel channel : kChannels) {
    lanes.push_back(lane_of(plan, channel, [&](std::size_t junction) -> const TransitionCut& {
      const JunctionCuts& cuts = plan.cuts[junction];
      return channel == Channel::tracks ? cuts.tracks : cuts.parts[static_cast<std::size_t>(channel)];
    }));
  }
  return lanes;
}

std::vector<std::size_t> places_of(const MotionClip& clip, std::size_t index) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < clip.signs.size(); ++i) places.push_back(place_of_sign(clip, i, index));
  return places;
}

/// The recording frames that its core shows: fewer than the clip's core if it was left before its end.
FrameRange core_of(const PlacedClip& placed) {
  const FrameRange core = placed.captured->core;
  if (placed.core_frames == placed_by_step(*placed.captured, placed.step).core_frames) return core;
  const auto shown = static_cast<std::int64_t>(std::ceil(static_cast<double>(placed.core_frames) * placed.step));
  return {core.begin, std::min(core.end, core.begin + std::max<std::int64_t>(shown, 1))};
}

/// Turns a score into a plan.
class Planner {
 public:
  Planner(const Score& score, const std::vector<MotionClip>& clips) : score_(score), clips_(clips) {
    for (const Lane& lane : score.lanes) chains_.push_back(chain_of(lane));
  }

  Plan plan() const {
    Plan plan = of_body();
    plan.curves = score_.curves;
    for (std::size_t lane = 0; lane < chains_.size(); ++lane) {
      const Channel channel = score_.lanes[lane].channel;
      check_positions(lane);
      if (channel == Channel::body) continue;
      const bool is_part = parent_of(channel).has_value();
      const LaneChain& parent = is_part ? chain(*parent_of(channel)) : chains_.front();
      for (const LaneDifference& difference : differences(chains_[lane], parent, is_part)) {
        if (channel == Channel::tracks) {
          throw Error(ErrorCode::bad_input, "lane 'tracks' has other clips than lane 'body'; it must have the same");
        }
        plan.runs.push_back(run_of(channel, chains_[lane], difference));
      }
    }
    return plan;
  }

 private:
  const LaneChain& chain(Channel channel) const {
    return chains_[static_cast<std::size_t>(lane_of(score_, channel) - score_.lanes.data())];
  }

  /// Adds a clip to a plan; `held` are the poses of it that are held.
  void place(ClipId id, const HeldFrames& held, Plan& plan) const {
    const Clip& clip = score_.clips[id];
    PlacedClip& placed = plan.placed.emplace_back(placed_by_step(clips_[id], clip.step));
    placed.core = clip.at.begin;
    placed.core_frames = clip.at.size();
    placed.standing = clip.standing;
    if (held.at_end > 0) placed.after = score_.frames - held.at_end - clip.at.end;
    if (!held.any()) return;
    HeldClip with_held = hold(placed, held);
    placed = with_held.placed;
    plan.held.push_back(std::move(with_held.clip));
  }

  /// What is held of a link of a chain. `within` says that the transition after it belongs to the plan.
  static HeldFrames held_of(const LaneChain& chain, std::size_t link, bool within) {
    const bool last = link + 1 == chain.size();
    return {.before = chain[link].held_before,
            .after_core = !last && within ? chain[link].held : 0,
            .at_end = last ? chain[link].held : 0};
  }

  /// The cut of a body's junction in an arm or the tracks; the body's own if that lane leads elsewhere there.
  std::vector<TransitionCut> cuts_in(Channel channel) const {
    const LaneChain& body = chains_.front();
    std::vector<TransitionCut> cuts;
    for (std::size_t i = 0; i + 1 < body.size(); ++i) cuts.push_back(body[i].cut);
    const LaneChain& lane = chain(channel);
    for (std::size_t i = 0; i + 1 < lane.size(); ++i) {
      const std::size_t clip = lane[i].clip;
      if (clip + 1 < body.size() && lane[i + 1].clip == clip + 1 && lane[i].held == body[clip].held) {
        cuts[clip] = lane[i].cut;
      }
    }
    return cuts;
  }

  Plan of_body() const {
    const LaneChain& body = chains_.front();
    Plan plan;
    plan.frames = score_.frames;
    for (std::size_t i = 0; i < body.size(); ++i) place(body[i].clip, held_of(body, i, true), plan);
    plan.cuts.resize(body.size() - 1);
    for (const Timed part : kAllTimed) {
      const std::vector<TransitionCut> cuts = cuts_in(channel_of(part));
      for (std::size_t i = 0; i < cuts.size(); ++i) plan.cuts[i].parts[static_cast<std::size_t>(part)] = cuts[i];
    }
    const std::vector<TransitionCut> tracks = cuts_in(Channel::tracks);
    for (std::size_t i = 0; i < tracks.size(); ++i) plan.cuts[i].tracks = tracks[i];
    finish(plan, body, true, true);
    return plan;
  }

  LaneRun run_of(Channel channel, const LaneChain& lane, const LaneDifference& difference) const {
    LaneRun run{
        .channel = channel,
        .frames = {difference.from_parent ? score_.clips[lane[difference.first].clip].at.end : 0,
                   difference.back_to_parent ? score_.clips[lane[difference.last].clip].at.begin : score_.frames},
        .from_parent = difference.from_parent,
        .back_to_parent = difference.back_to_parent,
        .plan = {},
        .clips = {},
        .places = {}};
    run.plan.frames = score_.frames;
    for (std::size_t i = difference.first; i <= difference.last; ++i) {
      const bool within = i < difference.last || !difference.back_to_parent;
      place(lane[i].clip, held_of(lane, i, within), run.plan);
      run.clips.push_back(lane[i].clip);
      run.places.push_back(lane[i].place);
      if (i == difference.last) break;
      JunctionCuts& cuts = run.plan.cuts.emplace_back(JunctionCuts{.parts = {}, .tracks = lane[i].cut});
      cuts.parts.fill(lane[i].cut);
    }
    finish(run.plan, std::span(lane).subspan(difference.first, run.plan.placed.size()), !difference.from_parent,
           !difference.back_to_parent);
    return run;
  }

  /// Records what is shown of each preparation and retraction, and checks that it was captured.
  void finish(Plan& plan, std::span<const LaneLink> links, bool from_begin, bool to_end) const {
    if (from_begin) plan.placed.front().before = plan.placed.front().core;
    for (std::size_t i = 0; i < plan.cuts.size(); ++i) {
      for (const TransitionCut& cut : plan.cuts[i].parts) {
        plan.placed[i].after = std::max(plan.placed[i].after, cut.retraction_frames);
        plan.placed[i + 1].before = std::max(plan.placed[i + 1].before, cut.preparation_frames);
      }
    }
    if (to_end) plan.placed.back().after = plan.frames - plan.placed.back().core_end();
    for (std::size_t i = 0; i < plan.placed.size(); ++i) {
      const PlacedClip& placed = plan.placed[i];
      const auto require = [&](bool holds, std::string_view what, std::int64_t shown, std::int64_t captured) {
        if (holds) return;
        throw Error(ErrorCode::bad_input, fmt::format("the score shows {} frames {} clip {}, where {} were captured",
                                                      shown, what, links[i].clip, captured));
      };
      const std::int64_t tracks_before = i > 0 ? plan.cuts[i - 1].tracks.preparation_frames : 0;
      const std::int64_t tracks_after = i < plan.cuts.size() ? plan.cuts[i].tracks.retraction_frames : 0;
      const std::int64_t before = std::max(placed.before, tracks_before);
      const std::int64_t after = std::max(placed.after, tracks_after);
      require(before <= placed.preparation, "before the core of", before, placed.preparation);
      require(placed.after >= 0 && after <= placed.retraction, "after the core of", after, placed.retraction);
    }
  }

  void check_positions(std::size_t lane) const {
    const Channel channel = score_.lanes[lane].channel;
    if (lane_of(channel, chains_[lane], score_.clips, score_.frames) == score_.lanes[lane]) return;
    throw Error(
        ErrorCode::bad_input,
        fmt::format("lane '{}' does not lie where its cuts and the cores of its clips put it", name_of(channel)));
  }

  const Score& score_;
  const std::vector<MotionClip>& clips_;
  std::vector<LaneChain> chains_;  ///< [lane]
};

}  // namespace

std::vector<MotionClip> clips_of(const Score& score, const FindSource& find) {
  std::vector<MotionClip> clips;
  for (const Clip& clip : score.clips) {
    const ScoreSource source = find(clip.source);
    if (clip.whole.end > source.motion->frame_count()) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("clip {} goes up to frame {} of '{}', which has {}", clip.id, clip.whole.end,
                              clip.source.recording, source.motion->frame_count()));
    }
    MotionClip& opened = clips.emplace_back(MotionClip{.recording = clip.source.recording,
                                                       .source = source.motion,
                                                       .whole = clip.whole,
                                                       .core = clip.core,
                                                       .clock = clip.clock,
                                                       .signs = clip.signs,
                                                       .fingerprint = clip.source.fingerprint,
                                                       .place = clip.place,
                                                       .sign_places = clip.sign_places,
                                                       .kind = clip.source.kind,
                                                       .noise = source.noise,
                                                       .mirrored = clip.mirrored,
                                                       .at_rest = clip.at_rest,
                                                       .changes = clip.changes});
    if (clip.id == 0) continue;
    const JunctionRef& junction = score.junctions[clip.id - 1];
    if (!junction.chosen.empty()) opened.junction = parse_junction("1=" + junction.chosen).choice;
    opened.junction.method = find_transition_method(junction.method);
  }
  return clips;
}

Plan plan_of(const Score& score, const std::vector<MotionClip>& clips) {
  return Planner(score, clips).plan();
}

std::vector<MotionClip> clips_around(std::span<const FrameRange> gaps, const MotionClip& motion) {
  std::vector<MotionClip> clips;
  std::int64_t begin = motion.core.begin;
  for (std::size_t i = 0; i <= gaps.size(); ++i) {
    MotionClip& clip = clips.emplace_back(motion);
    clip.core = clip.whole = {begin, i < gaps.size() ? gaps[i].begin : motion.core.end};
    if (i < gaps.size()) begin = gaps[i].end;
  }
  return clips;
}

Plan plan_with_gaps(const std::vector<MotionClip>& clips, std::span<const std::int64_t> counts) {
  Plan plan;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    PlacedClip& placed = plan.placed.emplace_back(placed_by_step(clips[i], 1));
    placed.core = plan.frames;
    plan.frames = placed.core_end();
    if (i == counts.size()) break;
    const TransitionCut cut{.length = counts[i]};
    JunctionCuts& cuts = plan.cuts.emplace_back(JunctionCuts{.parts = {}, .tracks = cut});
    cuts.parts.fill(cut);
    plan.frames += cut.length;
  }
  return plan;
}

Clip clip_of(const PlacedClip& placed, ClipId id) {
  const MotionClip& clip = *placed.captured;
  return {.id = id,
          .place = clip.place.value_or(id),
          .source = source_of(clip),
          .whole = clip.whole,
          .core = core_of(placed),
          .step = placed.step,
          .at = {placed.core, placed.core_end()},
          .standing = placed.standing,
          .clock = clip.clock,
          .signs = clip.signs,
          .sign_places = places_of(clip, id),
          .mirrored = clip.mirrored,
          .at_rest = clip.at_rest,
          .changes = clip.changes};
}

Score score_of(const Plan& plan, const JunctionSettings& settings, const SourceRef& skeleton) {
  Score score{.skeleton = skeleton,
              .rate = settings.rate,
              .frames = plan.frames,
              .clips = {},
              .junctions = {},
              .lanes = {},
              .curves = plan.curves};
  for (std::size_t i = 0; i < plan.placed.size(); ++i) {
    const PlacedClip& placed = plan.placed[i];
    const MotionClip& clip = *placed.captured;
    score.clips.push_back(clip_of(placed, static_cast<ClipId>(i)));
    if (i > 0) {
      score.junctions.push_back({.number = clip.place.value_or(i),
                                 .method = std::string(method_of(settings, placed).name),
                                 .chosen = to_string(clip.junction)});
    }
  }
  score.lanes = lanes_of(plan);
  return score;
}

}  // namespace signweave
