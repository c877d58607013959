#include "signweave/render/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/core/error.h"

namespace signweave {
namespace {

const TransitionCut& cut_of(const Score& score, Channel channel, std::size_t junction) {
  return std::get<Transition>(score.lanes[static_cast<std::size_t>(channel)].items[2 * junction + 1].what).cut;
}

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
                                                       .mirrored = clip.mirrored});
    if (clip.id == 0) continue;
    const JunctionRef& junction = score.junctions[clip.id - 1];
    if (!junction.chosen.empty()) opened.junction = parse_junction("1=" + junction.chosen).choice;
    opened.junction.method = find_transition_method(junction.method);
  }
  return clips;
}

Plan plan_of(const Score& score, const std::vector<MotionClip>& clips) {
  Plan plan;
  plan.frames = score.frames;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    const Clip& clip = score.clips[i];
    plan.placed.push_back(placed_by_step(clips[i], clip.step));
    plan.placed.back().core = clip.at.begin;
    plan.placed.back().core_frames = clip.at.size();
    plan.placed.back().standing = clip.standing;
  }
  plan.placed.front().before = plan.placed.front().core;
  for (std::size_t i = 0; i + 1 < clips.size(); ++i) {
    JunctionCuts& cuts = plan.cuts.emplace_back();
    for (const Timed part : kAllTimed) cuts.parts[static_cast<std::size_t>(part)] = cut_of(score, channel_of(part), i);
    cuts.tracks = cut_of(score, Channel::tracks, i);
    for (const TransitionCut& cut : cuts.parts) {
      plan.placed[i].after = std::max(plan.placed[i].after, cut.retraction_frames);
      plan.placed[i + 1].before = std::max(plan.placed[i + 1].before, cut.preparation_frames);
    }
  }
  plan.placed.back().after = score.frames - plan.placed.back().core_end();
  for (std::size_t i = 0; i < plan.placed.size(); ++i) {
    const PlacedClip& placed = plan.placed[i];
    const auto require = [&](bool holds, std::string_view what, std::int64_t shown, std::int64_t captured) {
      if (holds) return;
      throw Error(ErrorCode::bad_input, fmt::format("the score shows {} frames {} clip {}, where {} were captured",
                                                    shown, what, i, captured));
    };
    const std::int64_t tracks_before = i > 0 ? plan.cuts[i - 1].tracks.preparation_frames : 0;
    const std::int64_t tracks_after = i < plan.cuts.size() ? plan.cuts[i].tracks.retraction_frames : 0;
    const std::int64_t before = std::max(placed.before, tracks_before);
    const std::int64_t after = std::max(placed.after, tracks_after);
    require(before <= placed.preparation, "before the core of", before, placed.preparation);
    require(placed.after >= 0 && after <= placed.retraction, "after the core of", after, placed.retraction);
  }
  const std::vector<Lane> lanes = lanes_of(plan);
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    if (lanes[i] == score.lanes[i]) continue;
    throw Error(ErrorCode::bad_input,
                fmt::format("lane '{}' does not lie where its cuts and the cores of its clips put it",
                            name_of(lanes[i].channel)));
  }
  return plan;
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

Score score_of(const Plan& plan, const JunctionSettings& settings, const SourceRef& skeleton) {
  Score score{
      .skeleton = skeleton, .rate = settings.rate, .frames = plan.frames, .clips = {}, .junctions = {}, .lanes = {}};
  for (std::size_t i = 0; i < plan.placed.size(); ++i) {
    const PlacedClip& placed = plan.placed[i];
    const MotionClip& clip = *placed.captured;
    score.clips.push_back({.id = static_cast<ClipId>(i),
                           .place = clip.place.value_or(i),
                           .source = source_of(clip),
                           .whole = clip.whole,
                           .core = core_of(placed),
                           .step = placed.step,
                           .at = {placed.core, placed.core_end()},
                           .standing = placed.standing,
                           .clock = clip.clock,
                           .signs = clip.signs,
                           .sign_places = places_of(clip, i),
                           .mirrored = clip.mirrored});
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
