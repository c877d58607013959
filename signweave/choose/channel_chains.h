#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "signweave/choose/channel_clips.h"

namespace signweave {

/// A clip in a channel, before its time is known.
struct ChannelLink {
  std::size_t clip = 0;                   ///< number among the whole-body clips and, after them, those of the parts
  std::optional<std::size_t> held_until;  ///< whole-body clip until whose core's end its last pose is held
  std::size_t first = 0;                  ///< number of the first whole-body clip whose time it takes
  std::size_t last = 0;                   ///< inclusive
  bool own = false;                       ///< it is of a part of this very channel
};

struct ChannelChain {
  Channel channel = Channel::body;
  std::vector<ChannelLink> links;  ///< in time order, not empty
};

/// What a channel shows at first, instead of the first whole-body clips.
struct ChannelStart {
  Channel channel = Channel::left;
  std::vector<ChannelLink> links;  ///< `first` and `last` are the last of those whole-body clips
  bool stays = false;              ///< fingers that keep what they show when their held hand is lowered
};

/// What each channel shows one after another: the channels of kChannels, then those of kPartChannels that have parts.
/// `clips` are the whole-body clips, `body` in number, then those of the parts. With `starts`, one for each channel of
/// kChannels at least, channels begin with these; the first `known` parts are of them. Throws Error{bad_input} if parts
/// of one channel contradict each other, naming them.
std::vector<ChannelChain> channel_chains(const ChannelParts& parts, const std::vector<MotionClip>& clips,
                                         std::size_t body, const std::vector<ChannelStart>& starts = {},
                                         std::size_t known = 0);

}  // namespace signweave
