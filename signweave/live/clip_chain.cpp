#include "signweave/live/clip_chain.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "signweave/render/plan.h"
#include "signweave/score/lane_chain.h"

namespace signweave {
namespace {

const TransitionCut& cut_of(const JunctionCuts& cuts, Channel channel) noexcept {
  const Channel whole = parent_of(channel).value_or(channel);
  return whole == Channel::tracks ? cuts.tracks : cuts.parts[static_cast<std::size_t>(whole)];
}

/// The links of a stream's lanes from one of its clips on, as a score.
class ScoreOfLinks {
 public:
  ScoreOfLinks(const LiveLanes& lanes, std::size_t first, const TransitionBuilder& builder, const SourceRef& skeleton)
      : lanes_(lanes), builder_(builder) {
    const LiveClip& front = *lanes.front()[first].clip;
    score_.skeleton = skeleton;
    score_.rate = builder.settings().rate;
    begin_ = front.placed.core - shown_before(front);
    for (std::size_t channel = 0; channel < lanes.size(); ++channel) {
      first_[channel] = first_link(lanes[channel], front);
      begin_ = std::min(begin_, lanes[channel][first_[channel]].clip->placed.core);
    }
  }

  std::int64_t begin() const noexcept { return begin_; }

  /// The score up to output frame `end`, or for lanes that differ, to the last retraction.
  std::optional<Score> up_to(std::int64_t end, bool is_uniform) && {
    const PlacedClip& last = lanes_.front().back().clip->placed;
    if (end <= last.core && is_uniform) return std::nullopt;  // nothing of it is known yet
    score_.frames = end - begin_;
    if (!is_uniform) {
      for (const std::deque<LiveLink>& lane : lanes_) {
        const PlacedClip& placed = lane.back().clip->placed;
        score_.frames =
            std::max(score_.frames, placed.core_end() + (lane.back().held_until ? 0 : placed.retraction) - begin_);
      }
    }
    for (std::size_t channel = 0; channel < lanes_.size(); ++channel) {
      for (std::size_t i = first_[channel]; i < lanes_[channel].size(); ++i) add(*lanes_[channel][i].clip);
    }
    std::vector<LaneChain> chains;
    for (const Channel channel : kAllChannels) chains.push_back(chain_of(static_cast<std::size_t>(channel)));
    for (const Channel channel : kAllChannels) {
      const LaneChain& chain = chains[static_cast<std::size_t>(channel)];
      const std::optional<Channel> parent = parent_of(channel);
      if (parent && differences(chain, chains[static_cast<std::size_t>(*parent)], true).empty()) continue;
      score_.lanes.push_back(lane_of(channel, chain, score_.clips, score_.frames));
    }
    return std::move(score_);
  }

 private:
  /// The transition to the first clip is not part of the score.
  static std::int64_t shown_before(const LiveClip& front) noexcept { return front.cuts ? 0 : front.placed.preparation; }

  static std::size_t first_link(const std::deque<LiveLink>& lane, const LiveClip& front) {
    std::size_t found = 0;
    for (std::size_t i = 0; i < lane.size(); ++i) {
      if (lane[i].clip.get() == &front) return i;
      if (lane[i].clip->placed.core <= front.placed.core) found = i;
    }
    return found;
  }

  void add(const LiveClip& live) {
    const auto [at, is_new] = ids_.emplace(&live, static_cast<ClipId>(score_.clips.size()));
    if (!is_new) return;
    PlacedClip placed = live.placed;
    placed.core -= begin_;
    placed.core_frames = std::min(placed.core_frames, score_.frames - placed.core);
    score_.clips.push_back(clip_of(placed, at->second));
    if (at->second == 0) return;
    score_.junctions.push_back({.number = live.captured.place.value_or(at->second),
                                .method = std::string(method_of(builder_.settings(), placed).name),
                                .chosen = to_string(live.captured.junction)});
  }

  LaneChain chain_of(std::size_t channel) const {
    LaneChain chain;
    const std::deque<LiveLink>& lane = lanes_[channel];
    for (std::size_t i = first_[channel]; i < lane.size(); ++i) {
      chain.push_back(
          {.clip = ids_.at(lane[i].clip.get()), .held = lane[i].held, .cut = lane[i].cut, .place = lane[i].place});
    }
    const LiveLink& last = lane.back();
    const Clip& clip = score_.clips[chain.back().clip];
    const std::int64_t shown_after = last.held_until ? 0 : last.clip->placed.retraction;
    chain.back().held = std::max<std::int64_t>(0, score_.frames - clip.at.end - shown_after);
    chain.back().cut = {};
    const LiveClip& front = *lane[first_[channel]].clip;
    const std::int64_t before = score_.clips[chain.front().clip].at.begin - front.placed.preparation;
    chain.front().held_before = std::max<std::int64_t>(0, before);
    return chain;
  }

  const LiveLanes& lanes_;
  const TransitionBuilder& builder_;
  Score score_;
  std::int64_t begin_ = 0;
  std::array<std::size_t, kAllChannels.size()> first_ = {};
  std::unordered_map<const LiveClip*, ClipId> ids_;
};

}  // namespace

bool ClipChain::is_uniform() const noexcept {
  return std::ranges::all_of(lanes_, [&](const auto& lane) { return lane.back().clip == back(); });
}

std::int64_t ClipChain::core_end() const noexcept {
  std::int64_t end = back()->placed.core_end();
  for (const std::deque<LiveLink>& lane : lanes_) {
    if (!lane.back().held_until) end = std::min(end, lane.back().clip->placed.core_end());
  }
  return end;
}

void ClipChain::clear() noexcept {
  for (std::deque<LiveLink>& lane : lanes_) lane.clear();
}

void ClipChain::begin(std::shared_ptr<LiveClip> clip) {
  clear();
  add(std::move(clip));
}

void ClipChain::number(LiveClip& clip) {
  clip.number = next_number_++;
  if (!clip.captured.place) clip.captured.place = empty() ? 0 : back()->captured.place;
}

void ClipChain::add(std::shared_ptr<LiveClip> clip) {
  number(*clip);
  for (const Channel channel : kAllChannels) {
    std::deque<LiveLink>& lane = lanes_[static_cast<std::size_t>(channel)];
    if (!lane.empty() && clip->cuts) lane.back().cut = cut_of(*clip->cuts, channel);
    lane.push_back({.clip = clip});
  }
  forget();
}

void ClipChain::add(const LiveLanes& links) {
  const auto shows = [](const std::deque<LiveLink>& lane, const std::shared_ptr<LiveClip>& clip) {
    return std::ranges::find(lane, clip, &LiveLink::clip) != lane.end();
  };
  for (const Channel channel : kAllChannels) {
    for (const LiveLink& link : links[static_cast<std::size_t>(channel)]) {
      if (!shows(body(), link.clip) && !shows(lane(channel), link.clip)) link.clip->number = next_number_;
    }
  }
  for (const LiveLink& link : links.front()) {
    if (!shows(body(), link.clip)) number(*link.clip);
  }
  for (std::size_t channel = 0; channel < lanes_.size(); ++channel) {
    std::deque<LiveLink>& lane = lanes_[channel];
    lane.erase(std::ranges::find(lane, links[channel].front().clip, &LiveLink::clip), lane.end());
    lane.insert(lane.end(), links[channel].begin(), links[channel].end());
  }
  forget();
}

/// Drops clips before the last kMostClips of the body, and what other channels show before the first one.
void ClipChain::forget() {
  while (body().size() > kMostClips) {
    body().pop_front();
    const std::int64_t core = body().front().clip->placed.core;
    for (std::deque<LiveLink>& lane : lanes_) {
      while (lane.size() > 1 && lane[1].clip->placed.core <= core) lane.pop_front();
    }
  }
}

void ClipChain::end_with(const std::shared_ptr<LiveClip>& clip) {
  if (std::ranges::find(body(), clip, &LiveLink::clip) == body().end()) {
    clear();
    for (std::deque<LiveLink>& lane : lanes_) lane.push_back({.clip = clip});
  }
  for (std::deque<LiveLink>& lane : lanes_) {
    while (lane.size() > 1 && lane.back().clip->number > clip->number) lane.pop_back();
  }
  next_number_ = clip->number + 1;
}

void ClipChain::replace_back(std::shared_ptr<LiveClip> clip) {
  const std::shared_ptr<LiveClip> before = back();
  clip->number = before->number;
  for (std::deque<LiveLink>& lane : lanes_) {
    if (lane.back().clip == before) lane.back().clip = clip;
  }
}

std::optional<ShownScore> ClipChain::score(const TransitionBuilder& builder, const SourceRef& skeleton,
                                           std::int64_t next, std::int64_t end, std::size_t most_clips) const {
  if (empty()) return std::nullopt;
  const std::size_t first = body().size() - std::min(body().size(), std::max<std::size_t>(most_clips, 1));
  ScoreOfLinks links(lanes_, first, builder, skeleton);
  const std::int64_t begin = links.begin();
  std::optional<Score> score = std::move(links).up_to(end, is_uniform());
  if (!score) return std::nullopt;
  return ShownScore{
      .score = std::move(*score), .next = next - begin, .known = end - begin, .first_clip = body()[first].clip->number};
}

}  // namespace signweave
