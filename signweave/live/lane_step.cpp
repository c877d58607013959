#include "signweave/live/lane_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "signweave/choose/compose.h"
#include "signweave/choose/lint.h"
#include "signweave/core/error.h"
#include "signweave/render/render.h"
#include "signweave/score/lane_chain.h"

namespace signweave {
namespace {

/// Maximum number of frames made at once.
constexpr std::int64_t kMostMade = 60'000;

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

  /// Moves the new clips to where the signer stands.
  void stand(TransitionBuilder& builder) {
    for (std::size_t i = 0; i < live_.size(); ++i) {
      if (before_.fixed[i]) continue;
      builder.place_first(*live_[i]);
      before_.placed[i].standing = live_[i]->placed.standing;
    }
  }

  Score compose(const JunctionSettings& settings, const ConcatenateOptions& options) const {
    return compose_after(before_, clips_, body_, parts_, settings, options);
  }

  /// Everything that the frames from `begin` on depend on; empty: unknown.
  std::string key(std::int64_t begin, const StepClips& clips, const StreamSetup& setup) const {
    std::string key = fmt::format("{}|{}|{}", setup.key, body_, clips.rests);
    for (std::size_t i = 0; i < live_.size(); ++i) {
      if (live_[i]->key.empty()) return {};
      key += fmt::format("|{} {} {}", live_[i]->key, clips_[i].pause_before.count(), clips_[i].continues);
      if (before_.fixed[i])
        key += fmt::format(" at {} {}", live_[i]->placed.core - begin, live_[i]->placed.core_frames);
      for (const Sign& sign : clips_[i].signs) key += fmt::format(" {}", sign.gloss);  // notices have them
    }
    for (const ChannelStart& start : before_.starts) {
      key += fmt::format("|{} {}", name_of(start.channel), start.stays);
      for (const ChannelLink& link : start.links) {
        key += fmt::format(" {} {}", link.clip, link.held_until ? static_cast<std::int64_t>(*link.held_until) : -1);
        if (const auto& place = before_.places[link.clip]) {
          key += fmt::format(" {} {} {} {} {}", static_cast<int>(place->anchor), static_cast<int>(place->kept_in),
                             place->out.x(), place->out.y(), place->out.z());
        }
      }
    }
    for (std::size_t i = before_.known_parts; i < parts_.clips.size(); ++i) {
      const ChannelClip& part = parts_.clips[i];
      key += fmt::format("|{} {} {} {} {}", name_of(part.channel), part.first, part.last, part.fill, part.lower);
      for (const ClipSync& sync : part.sync) {
        key += fmt::format(" {} {} {}", static_cast<int>(sync.anchor), sync.with, sync.offset.count());
      }
    }
    for (const ChannelHold& held : parts_.holds) {
      key += fmt::format("|hold {} {} {}", name_of(held.channel), held.from, held.until);
    }
    return key;
  }

  /// What is reported of the new signs. `frames` are those of the score from `first` on.
  std::vector<Notice> lint(const Score& score, const Motion& frames, std::int64_t first, const SignerRig& rig) const {
    return lint_channels({.score = score,
                          .clips = clips_,
                          .body = body_,
                          .parts = parts_,
                          .motion = frames,
                          .first = first,
                          .before = &before_},
                         rig);
  }

  MadeStep made_of(const Score& score, std::int64_t begin, std::shared_ptr<const Motion> frames) const {
    MadeStep made{.frames = std::move(frames), .refused = {}, .clips = {}, .lanes = {}};
    for (const Clip& clip : score.clips) {
      made.clips.push_back({.to_core = base_ + clip.at.begin - begin,
                            .step = clip.step,
                            .core_frames = clip.at.size(),
                            .standing = clip.standing});
    }
    const std::vector<ChannelChain> chains = channel_chains(parts_, clips_, body_, before_.starts, before_.known_parts);
    for (const Channel channel : kAllChannels) {
      auto shown = std::ranges::find(chains, channel, &ChannelChain::channel);
      if (shown == chains.end()) shown = std::ranges::find(chains, *parent_of(channel), &ChannelChain::channel);
      const LaneChain lane = chain_of(*lane_of(score, shown->channel));
      for (std::size_t i = 0; i < lane.size(); ++i) {
        made.lanes[static_cast<std::size_t>(channel)].push_back(
            {.clip = lane[i].clip,
             .held = i + 1 < lane.size() ? lane[i].held : 0,
             .held_until = shown->links[i].held_until,
             .cut = lane[i].cut,
             .place = side_of_arm(channel) ? lane[i].place : std::nullopt});
      }
    }
    return made;
  }

  /// The step of this window's clips. Gives the new ones their places.
  LaneStep step_of(const MadeStep& made, std::int64_t begin) const {
    LaneStep step{.made = made.frames, .begin = begin, .links = {}, .cores = {}, .clips = {}, .notices = made.notices};
    for (std::size_t i = 0; i < live_.size(); ++i) {
      const MadeStep::Placed& at = made.clips[i];
      step.cores.emplace_back(live_[i], at.to_core);
      if (before_.fixed[i]) continue;
      PlacedClip& placed = live_[i]->placed;
      if (at.step != placed.step || at.core_frames != placed.core_frames) {  // it fills another clip
        placed = placed_by_step(live_[i]->captured, at.step);
        placed.core_frames = at.core_frames;
      }
      placed.standing = at.standing;
      placed.core = begin + at.to_core;
    }
    for (std::size_t channel = 0; channel < made.lanes.size(); ++channel) {
      for (const MadeStep::Link& link : made.lanes[channel]) {
        step.links[channel].push_back({.clip = live_[link.clip],
                                       .held = link.held,
                                       .held_until = link.held_until ? live_[*link.held_until] : nullptr,
                                       .cut = link.cut,
                                       .place = link.place});
      }
    }
    const std::deque<LiveLink>& body = step.links.front();
    for (std::size_t i = 0; i + 1 < body.size(); ++i) {
      if (body[i + 1].clip->cuts) continue;
      JunctionCuts& cuts = body[i + 1].clip->cuts.emplace(JunctionCuts{.parts = {}, .tracks = body[i].cut});
      cuts.parts.fill(body[i].cut);
    }
    return step;
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
      const bool stays = std::ranges::find(clips.stay, channel) != clips.stay.end();
      ChannelStart& start = before_.starts.emplace_back(ChannelStart{.channel = channel, .links = {}, .stays = stays});
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

std::size_t held_bytes(const MadeStep& made) noexcept {
  std::size_t links = 0;
  std::size_t text = 0;
  for (const auto& lane : made.lanes) links += lane.size();
  for (const Notice& notice : made.notices) text += sizeof(Notice) + notice.text.size();
  if (made.refused) text += std::string_view(made.refused->what()).size();
  return sizeof(MadeStep) + text + (made.frames ? bytes_in(*made.frames) : 0) +
         made.clips.size() * sizeof(MadeStep::Placed) + links * sizeof(MadeStep::Link);
}

LaneStep make_step(const ClipChain& chain, std::int64_t begin, const StepClips& clips, StreamSetup& setup, double tempo,
                   StepCache& cache) {
  const JunctionSettings& settings = setup.builder->settings();
  StepWindow window(chain, begin, clips);
  const auto with_clips = [&](const MadeStep& made) {
    LaneStep step = window.step_of(made, begin);
    step.clips = clips;
    step.had_tail = !chain.empty();
    return step;
  };
  const std::string key = window.key(begin, clips, setup);
  if (!key.empty()) {
    if (const std::shared_ptr<const MadeStep> made = cache.find(key)) {
      if (made->refused) throw Error(*made->refused);
      return with_clips(*made);
    }
  }
  window.stand(*setup.builder);
  const Score score = [&] {
    try {
      return window.compose(settings, {.fit = setup.fit.get(),
                                       .tempo = tempo,
                                       .most_frames = std::numeric_limits<std::int64_t>::max(),
                                       .author = {}});
    } catch (const Error& error) {
      if (!key.empty() && error.code() == ErrorCode::bad_input) {
        cache.keep(key, std::make_shared<MadeStep>(MadeStep{.frames = {}, .refused = error, .clips = {}, .lanes = {}}));
      }
      throw;
    }
  }();
  const Clip& last = score.clips[window.body() - 1];
  const bool differ = std::ranges::any_of(score.lanes, [&](const Lane& lane) {
    const auto use = std::find_if(lane.items.rbegin(), lane.items.rend(),
                                  [](const Item& item) { return std::holds_alternative<ClipUse>(item.what); });
    return std::get<ClipUse>(use->what).clip != last.id;
  });
  const FrameRange frames{begin - window.base(), clips.rests ? last.at.begin : differ ? score.frames : last.at.end};
  if (frames.size() > kMostMade) {
    throw Error(ErrorCode::bad_input, fmt::format("these signs take {} frames at once, more than {}; ask for a lower "
                                                  "rate, or leave out some of what belongs together",
                                                  frames.size(), kMostMade));
  }
  Renderer renderer(plan_of(score, window.clips()), settings);
  Motion rendered;
  renderer.render(frames, rendered);
  auto made = std::make_shared<MadeStep>(
      window.made_of(score, begin, with_tracks(std::move(rendered), setup.builder->tracks())));
  if (!clips.body.empty() && !clips.rests) made->notices = window.lint(score, *made->frames, frames.begin, *setup.rig);
  if (!key.empty()) cache.keep(key, made);
  return with_clips(*made);
}

}  // namespace signweave
