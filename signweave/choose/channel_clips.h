#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/score/motion_clip.h"
#include "signweave/score/score.h"

namespace signweave {

/// The first gloss of a clip in quotes, or its recording: for messages.
std::string quoted_name(const MotionClip& clip);

/// Ties the core of a channel's clip to the core of a whole-body clip.
struct ClipSync {
  enum class Anchor : std::uint8_t { begin, end };
  Anchor anchor = Anchor::begin;
  std::size_t with = 0;   ///< number of the whole-body clip
  Seconds offset{0};      ///< from its anchor to the same one of the channel's clip, exact at any frame rate
  bool at_least = false;  ///< the channel's clip may come later
};

/// A clip that one channel shows instead of some whole-body clips.
struct ChannelClip {
  Channel channel = Channel::left;  ///< none of body and tracks
  MotionClip clip;
  std::size_t first = 0;  ///< number of the first whole-body clip that the channel does not show
  std::size_t last = 0;   ///< inclusive; consecutive clips of one channel may have the same range
  std::vector<ClipSync> sync;
  bool fill = false;   ///< its core is stretched to that of clip `first`
  bool lower = false;  ///< the last frames of the last whole-body clip's retraction, shown after a hold until its end
};

/// A pose that one channel holds.
struct ChannelHold {
  Channel channel = Channel::left;
  std::size_t from = 0;   ///< number of a whole-body clip; what the channel shows with it is held after it
  std::size_t until = 0;  ///< number of the whole-body clip whose core's end ends the hold; after `from`
};

/// What single channels show besides the whole-body clips.
struct ChannelParts {
  std::vector<ChannelClip> clips;  ///< of each channel in the order of time
  std::vector<ChannelHold> holds;
  bool empty() const noexcept { return clips.empty() && holds.empty(); }
};

}  // namespace signweave
