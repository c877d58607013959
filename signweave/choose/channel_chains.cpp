#include "signweave/choose/channel_chains.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "signweave/core/error.h"

namespace signweave {
namespace {

[[noreturn]] void contradict(Channel channel, const std::string& one, const std::string& other) {
  throw Error(ErrorCode::bad_input, fmt::format("the lane '{}' cannot show {} and {} at the same time; leave out one "
                                                "of them, or end it earlier",
                                                name_of(channel), one, other));
}

/// Changes the links of one channel.
class ChainEditor {
 public:
  ChainEditor(ChannelChain& chain, const std::vector<MotionClip>& clips) : chain_(chain), clips_(clips) {}

  /// Shows a clip instead of some whole-body clips; after a clip of the same range, in addition.
  void replace(std::size_t clip, std::size_t first, std::size_t last) {
    std::vector<ChannelLink>& links = chain_.links;
    const ChannelLink link{.clip = clip, .held_until = {}, .first = first, .last = last, .own = true};
    const auto begin = std::ranges::find_if(links, [&](const ChannelLink& one) { return one.last >= first; });
    const auto end = std::find_if(begin, links.end(), [&](const ChannelLink& one) { return one.first > last; });
    for (auto at = begin; at != end; ++at) {
      if (!at->own && at->first >= first && at->last <= last) continue;
      if (at->own && at->first == first && at->last == last) {  // the next sign of a sequence
        links.insert(end, link);
        return;
      }
      contradict(chain_.channel, quoted_name(clips_[clip]), quoted_name(clips_[at->clip]));
    }
    links.insert(links.erase(begin, end), link);
  }

  void hold(std::size_t from, std::size_t until) {
    std::vector<ChannelLink>& links = chain_.links;
    const auto after = std::ranges::find_if(links, [&](const ChannelLink& one) { return one.first > from; });
    ChannelLink& held = *(after - 1);
    const auto end = std::find_if(after, links.end(), [&](const ChannelLink& one) { return one.first > until; });
    const std::string name = fmt::format("the held {}", quoted_name(clips_[held.clip]));
    if (held.held_until && held.held_until != from) contradict(chain_.channel, name, name + " until another place");
    if (held.last > from) contradict(chain_.channel, name, quoted_name(clips_[held.clip]));
    for (auto at = after; at != end; ++at) {
      if (at->own || at->held_until || at->last > until)
        contradict(chain_.channel, name, quoted_name(clips_[at->clip]));
    }
    held.held_until = until;
    links.erase(after, end);
  }

 private:
  ChannelChain& chain_;
  const std::vector<MotionClip>& clips_;
};

}  // namespace

std::vector<ChannelChain> channel_chains(const ChannelParts& parts, const std::vector<MotionClip>& clips,
                                         std::size_t body, const std::vector<ChannelStart>& starts, std::size_t known) {
  std::vector<ChannelChain> chains;
  const auto start_of = [&](Channel channel) { return std::ranges::find(starts, channel, &ChannelStart::channel); };
  const auto add = [&](Channel channel, std::vector<ChannelLink> links) {
    ChannelChain& chain = chains.emplace_back(ChannelChain{channel, std::move(links)});
    if (const auto start = start_of(channel); start != starts.end() && !start->links.empty()) {
      std::vector<ChannelLink> first = start->links;
      for (ChannelLink& link : first) {  // what a part shows with its parent is held with it
        const auto theirs = std::ranges::find(chain.links, link.clip, &ChannelLink::clip);
        if (theirs != chain.links.end() && theirs->held_until) link.held_until = theirs->held_until;
      }
      const auto is_lowered = [&](std::size_t clip) { return clip >= body && parts.clips[clip - body].lower; };
      std::erase_if(chain.links, [&](const ChannelLink& link) {
        return link.first <= first.back().last && (start->stays || !is_lowered(link.clip));
      });
      chain.links.insert(chain.links.begin(), first.begin(), first.end());
    }
    ChainEditor editor(chain, clips);
    for (std::size_t i = known; i < parts.clips.size(); ++i) {
      const ChannelClip& part = parts.clips[i];
      if (part.channel == channel && !part.lower) editor.replace(body + i, part.first, part.last);
    }
    for (const ChannelHold& held : parts.holds) {
      if (held.channel == channel) editor.hold(held.from, held.until);
    }
    for (std::size_t i = 0; i < parts.clips.size(); ++i) {
      const ChannelClip& part = parts.clips[i];
      if (part.channel != channel || !part.lower) continue;
      chain.links.push_back({.clip = body + i, .held_until = {}, .first = part.first, .last = part.last, .own = true});
    }
  };
  std::vector<ChannelLink> whole;
  for (std::size_t i = 0; i < body; ++i) whole.push_back({.clip = i, .held_until = {}, .first = i, .last = i});
  for (const Channel channel : kChannels) add(channel, whole);
  for (const Channel channel : kPartChannels) {
    const bool has_parts = start_of(channel) != starts.end() ||
                           std::any_of(parts.clips.begin() + static_cast<std::ptrdiff_t>(known), parts.clips.end(),
                                       [&](const ChannelClip& part) { return part.channel == channel; }) ||
                           std::ranges::find(parts.holds, channel, &ChannelHold::channel) != parts.holds.end();
    if (!has_parts) continue;
    std::vector<ChannelLink> of_parent = chains[static_cast<std::size_t>(*parent_of(channel))].links;
    for (ChannelLink& link : of_parent) link.own = false;
    add(channel, std::move(of_parent));
  }
  return chains;
}

}  // namespace signweave
