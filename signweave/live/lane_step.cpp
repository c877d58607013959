#include "signweave/live/lane_step.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "signweave/choose/compose.h"
#include "signweave/render/render.h"
#include "signweave/score/lane_chain.h"

namespace signweave {
namespace {

/// The last clips of a stream with the new ones, on a time grid that begins with the first of their cores.
class StepWindow {
 public:
  /// Frames of the chain before `begin` are decided.
  StepWindow(const ClipChain& chain, std::int64_t begin, const StepClips& clips) {
    if (!chain.empty()) add_known(chain, begin, clips);
    const std::size_t shift = known_body_ > 0 ? known_body_ - 1 : 0;
    if (chain.empty()) add_body(clips);
    for (std::size_t i = 0; i < clips.parts.clips.size(); ++i) {
      ChannelClip& part = parts_.clips.emplace_back(clips.parts.clips[i]);
      part.first += shift;
      part.last += shift;
      for (ClipSync& sync : part.sync) sync.with += shift;
      add(clips.of_parts[i], false);
    }
    for (ChannelHold held : clips.parts.holds) {
      held.from += shift;
      held.until += shift;
      parts_.holds.push_back(held);
    }
    base_ = begin;
    for (std::size_t i = 0; i < live_.size(); ++i) {
      if (before_.fixed[i]) base_ = std::min(base_, live_[i]->placed.core);
    }
    for (std::size_t i = 0; i < live_.size(); ++i) {
      PlacedClip& placed = before_.placed.emplace_back(live_[i]->placed);
      placed.core = before_.fixed[i] ? placed.core - base_ : 0;
      placed.before = placed.after = 0;
    }
  }

  std::size_t body() const noexcept { return body_; }
  std::int64_t base() const noexcept { return base_; }
  const std::vector<MotionClip>& clips() const noexcept { return clips_; }
  const std::vector<std::shared_ptr<LiveClip>>& live() const noexcept { return live_; }

  Score compose(const JunctionSettings& settings, const ConcatenateOptions& options) const {
    return compose_after(before_, clips_, body_, parts_, settings, options);
  }

  /// Gives the new clips the places that they have in a score.
  void take_places(const Score& score) {
    for (std::size_t i = 0; i < live_.size(); ++i) {
      if (before_.fixed[i]) continue;
      const Clip& clip = score.clips[i];
      PlacedClip& placed = live_[i]->placed;
      if (clip.step != placed.step || clip.at.size() != placed.core_frames) {  // it fills another clip
        const std::optional<GroundTransform> standing = placed.standing;
        placed = placed_by_step(live_[i]->captured, clip.step);
        placed.core_frames = clip.at.size();
        placed.standing = standing;
      }
      placed.core = base_ + clip.at.begin;
    }
  }

  LiveLanes links(const Score& score) const {
    const std::vector<ChannelChain> chains = channel_chains(parts_, clips_, body_, before_.starts, before_.known_parts);
    LiveLanes links;
    for (const Channel channel : kAllChannels) {
      const auto own = std::ranges::find(chains, channel, &ChannelChain::channel);
      const ChannelChain& shown =
          own != chains.end() ? *own : *std::ranges::find(chains, *parent_of(channel), &ChannelChain::channel);
      const LaneChain lane = chain_of(*lane_of(score, shown.channel));
      std::deque<LiveLink>& made = links[static_cast<std::size_t>(channel)];
      for (std::size_t i = 0; i < lane.size(); ++i) {
        const std::optional<std::size_t> until = shown.links[i].held_until;
        made.push_back({.clip = live_[lane[i].clip],
                        .held = i + 1 < lane.size() ? lane[i].held : 0,
                        .held_until = until ? live_[*until] : nullptr,
                        .cut = lane[i].cut,
                        .place = side_of_arm(channel) ? lane[i].place : std::nullopt});
      }
    }
    return links;
  }

 private:
  void add(const std::shared_ptr<LiveClip>& clip, bool fixed) {
    live_.push_back(clip);
    clips_.push_back(clip->captured);
    before_.fixed.push_back(fixed);
    before_.places.emplace_back();
  }

  void add_body(const StepClips& clips) {
    for (const std::shared_ptr<LiveClip>& clip : clips.body) add(clip, false);
    body_ = live_.size();
  }

  /// The number of the first link of a lane that matters for frames from `begin` on.
  static std::size_t first_at(const std::deque<LiveLink>& lane, std::int64_t begin) {
    std::size_t first = lane.size() - 1;
    while (first > 0 && lane[first].clip->placed.core_end() > begin) --first;
    return first;
  }

  /// What each lane shows around `begin` and after it.
  void add_known(const ClipChain& chain, std::int64_t begin, const StepClips& clips) {
    const std::deque<LiveLink>& body = chain.lane(Channel::body);
    for (std::size_t i = first_at(body, begin); i < body.size(); ++i) add(body[i].clip, true);
    known_body_ = live_.size();
    add_body(clips);
    for (const Channel channel : kAllChannels) {
      const std::deque<LiveLink>& lane = chain.lane(channel);
      if (const std::optional<Channel> parent = parent_of(channel)) {
        const std::deque<LiveLink>& theirs = chain.lane(*parent);
        if (std::ranges::equal(lane, theirs, {}, &LiveLink::clip, &LiveLink::clip)) continue;
      }
      ChannelStart& start = before_.starts.emplace_back(ChannelStart{.channel = channel, .links = {}});
      for (std::size_t i = first_at(lane, begin); i < lane.size(); ++i) {
        const std::size_t number = number_of(lane[i].clip, channel);
        if (side_of_arm(channel)) before_.places[number] = lane[i].place;
        start.links.push_back(
            {.clip = number, .held_until = {}, .first = known_body_ - 1, .last = known_body_ - 1, .own = false});
        if (lane[i].held_until) start.links.back().held_until = body_number(*lane[i].held_until);
      }
    }
  }

  std::size_t number_of(const std::shared_ptr<LiveClip>& clip, Channel channel) {
    const auto at = std::ranges::find(live_, clip);
    const auto number = static_cast<std::size_t>(at - live_.begin());
    if (at != live_.end()) return number;
    add(clip, true);
    parts_.clips.push_back({.channel = channel, .clip = {}, .sync = {}});
    ++before_.known_parts;
    return number;
  }

  /// An earlier clip than those of the window is over, so it is no different from the first.
  std::size_t body_number(const LiveClip& clip) const noexcept {
    for (std::size_t i = 0; i < known_body_; ++i) {
      if (live_[i].get() == &clip) return i;
    }
    return 0;
  }

  std::vector<std::shared_ptr<LiveClip>> live_;  ///< [clip] of the body, then of the parts
  std::vector<MotionClip> clips_;
  ChannelParts parts_;
  std::size_t body_ = 0;
  std::size_t known_body_ = 0;
  std::int64_t base_ = 0;
  Continuation before_;
};

/// The frames of a motion with the tracks in another order.
std::shared_ptr<const Motion> with_tracks(Motion motion, const std::vector<std::string>& names) {
  std::vector<ScalarTrack> tracks = motion.take_tracks();
  const auto frames = static_cast<std::size_t>(motion.frame_count());
  for (const std::string& name : names) {
    const auto at = std::ranges::find(tracks, name, &ScalarTrack::name);
    motion.add_track(at == tracks.end() ? ScalarTrack{name, std::vector<float>(frames, 0.0f)} : std::move(*at));
  }
  return std::make_shared<const Motion>(std::move(motion));
}

}  // namespace

std::int64_t LaneStep::to_core(const std::shared_ptr<LiveClip>& clip) const noexcept {
  const auto at = std::ranges::find(cores, clip, &std::pair<std::shared_ptr<LiveClip>, std::int64_t>::first);
  return at == cores.end() ? 0 : at->second;
}

void LaneStep::move_to(std::int64_t frame) {
  begin = frame;
  for (const auto& [clip, frames] : cores) clip->placed.core = begin + frames;
}

StepClips without_tail(StepClips clips, bool had_tail) {
  if (!had_tail) return clips;
  for (ChannelClip& part : clips.parts.clips) {
    --part.first;
    --part.last;
    for (ClipSync& sync : part.sync) --sync.with;
  }
  for (ChannelHold& held : clips.parts.holds) {
    --held.from;
    --held.until;
  }
  return clips;
}

LaneStep make_step(const ClipChain& chain, std::int64_t begin, const StepClips& clips, const StreamSetup& setup,
                   double tempo) {
  const JunctionSettings& settings = setup.builder->settings();
  StepWindow window(chain, begin, clips);
  const Score score = window.compose(
      settings,
      {.fit = setup.fit.get(), .tempo = tempo, .most_frames = std::numeric_limits<std::int64_t>::max(), .author = {}});
  const Clip& last = score.clips[window.body() - 1];
  const bool differ = std::ranges::any_of(score.lanes, [&](const Lane& lane) {
    const auto use = std::find_if(lane.items.rbegin(), lane.items.rend(),
                                  [](const Item& item) { return std::holds_alternative<ClipUse>(item.what); });
    return std::get<ClipUse>(use->what).clip != last.id;
  });
  const std::int64_t end = clips.rests ? last.at.begin : differ ? score.frames : last.at.end;
  Renderer renderer(plan_of(score, window.clips()), settings);
  Motion made;
  renderer.render({begin - window.base(), end}, made);

  window.take_places(score);
  LaneStep step{.made = with_tracks(std::move(made), setup.builder->tracks()),
                .begin = begin,
                .links = window.links(score),
                .clips = clips,
                .had_tail = !chain.empty()};
  for (const std::shared_ptr<LiveClip>& clip : window.live()) {
    step.cores.emplace_back(clip, clip->placed.core - begin);
  }
  const std::deque<LiveLink>& body = step.links.front();
  for (std::size_t i = 0; i + 1 < body.size(); ++i) {
    if (body[i + 1].clip->cuts) continue;
    JunctionCuts& cuts = body[i + 1].clip->cuts.emplace(JunctionCuts{.parts = {}, .tracks = body[i].cut});
    cuts.parts.fill(body[i].cut);
  }
  return step;
}

}  // namespace signweave
