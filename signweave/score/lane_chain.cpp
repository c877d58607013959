#include "signweave/score/lane_chain.h"

#include <unordered_map>

namespace signweave {

LaneChain chain_of(const Lane& lane) {
  LaneChain chain;
  std::int64_t held_before = 0;
  for (const Item& item : lane.items) {
    if (const auto* const use = std::get_if<ClipUse>(&item.what)) {
      chain.push_back({.clip = use->clip, .held_before = held_before, .cut = {}, .place = use->place});
      held_before = 0;
    } else if (std::holds_alternative<Hold>(item.what)) {
      (chain.empty() ? held_before : chain.back().held) = item.at.size();
    } else {
      chain.back().cut = std::get<Transition>(item.what).cut;
    }
  }
  return chain;
}

Lane lane_of(Channel channel, const LaneChain& chain, const std::vector<Clip>& clips, std::int64_t frames) {
  Lane lane{.channel = channel, .items = {}};
  std::int64_t begin = 0;
  if (!chain.empty() && chain.front().held_before > 0) {
    begin = chain.front().held_before;
    lane.items.push_back({Hold{chain.front().clip}, {0, begin}});
  }
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const LaneLink& link = chain[i];
    if (i + 1 == chain.size()) {
      lane.items.push_back({ClipUse{link.clip, link.place}, {begin, frames - link.held}});
      if (link.held > 0) lane.items.push_back({Hold{link.clip}, {frames - link.held, frames}});
      break;
    }
    const LaneLink& next = chain[i + 1];
    const std::int64_t core_end = clips[link.clip].at.end;
    const std::int64_t end = core_end + link.held + link.cut.kept_after();
    const std::int64_t resumes = clips[next.clip].at.begin - link.cut.kept_before();
    if (link.held > 0) {
      lane.items.push_back({ClipUse{link.clip, link.place}, {begin, core_end}});
      lane.items.push_back({Hold{link.clip}, {core_end, end}});
    } else {
      lane.items.push_back({ClipUse{link.clip, link.place}, {begin, end}});
    }
    lane.items.push_back({Transition{link.clip, next.clip, link.cut}, {end, resumes}});
    begin = resumes;
  }
  return lane;
}

std::vector<LaneDifference> differences(const LaneChain& lane, const LaneChain& parent, bool same_cuts) {
  constexpr auto kNone = static_cast<std::size_t>(-1);
  std::unordered_map<ClipId, std::size_t> parents;
  for (std::size_t i = 0; i < parent.size(); ++i) parents.emplace(parent[i].clip, i);
  std::vector<std::size_t> in_parent(lane.size(), kNone);
  for (std::size_t i = 0; i < lane.size(); ++i) {
    if (const auto at = parents.find(lane[i].clip); at != parents.end()) in_parent[i] = at->second;
  }
  const auto joined_alike = [&](std::size_t i) {
    if (in_parent[i] == kNone || in_parent[i + 1] != in_parent[i] + 1) return false;
    const LaneLink& theirs = parent[in_parent[i]];
    return lane[i].held == theirs.held && (!same_cuts || lane[i].cut == theirs.cut);
  };
  const bool begins_alike = in_parent.front() == 0 && lane.front().held_before == parent.front().held_before;
  const bool ends_alike = in_parent.back() == parent.size() - 1 && lane.back().held == parent.back().held;
  std::vector<LaneDifference> found;
  for (std::size_t i = 0; i < lane.size();) {
    const bool opens = i == 0 && !begins_alike;
    std::size_t last = i;
    while (last + 1 < lane.size() && !joined_alike(last)) ++last;
    const bool closes = last + 1 == lane.size() && !ends_alike;
    if (opens || closes || last > i) {
      found.push_back({.first = i, .last = last, .from_parent = !opens, .back_to_parent = !closes});
    }
    i = last + 1;
  }
  return found;
}

std::vector<const Lane*> lanes_that_differ(const Score& score) {
  std::vector<const Lane*> found;
  for (const Lane& lane : score.lanes) {
    const std::optional<Channel> parent = parent_of(lane.channel);
    const LaneChain theirs = chain_of(*lane_of(score, parent.value_or(Channel::body)));
    if (!differences(chain_of(lane), theirs, parent.has_value()).empty()) found.push_back(&lane);
  }
  return found;
}

}  // namespace signweave
