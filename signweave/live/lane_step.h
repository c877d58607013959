#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "signweave/choose/channel_clips.h"
#include "signweave/live/clip_chain.h"
#include "signweave/live/made_step.h"
#include "signweave/live/stream_setup.h"

/// Internal to this module.
namespace signweave {

/// Clips that a stream signs next, where single channels show others than the body does.
struct StepClips {
  std::vector<std::shared_ptr<LiveClip>> body;  ///< empty: held hands are lowered
  /// What channels show instead. Whole-body clips are counted from the last one of the stream, which is clip 0, or from
  /// the first new one if there is none. Their `clip` is not used.
  ChannelParts parts = {};
  std::vector<std::shared_ptr<LiveClip>> of_parts = {};  ///< [clip of the parts]
  bool rests = false;                                    ///< the last one is the rest, which goes on
  std::vector<Channel> stay = {};                        ///< see ChannelStart::stays
};

/// Such clips in their places, and the frames that they make.
struct LaneStep {
  std::shared_ptr<const Motion> made;  ///< what all channels together show from `begin` on, with the tracks
  std::int64_t begin = 0;              ///< output frame
  LiveLanes links;                     ///< of each channel: the stream's last one, if any, and the new ones
  /// All its clips, with the number of frames from `begin` to their cores.
  std::vector<std::pair<std::shared_ptr<LiveClip>, std::int64_t>> cores;

  StepClips clips;                   ///< those that it was made of
  bool had_tail = false;             ///< a clip was shown before them
  std::vector<Notice> notices = {};  ///< of lint_channels

  std::int64_t end() const noexcept { return begin + made->frame_count(); }
  /// The frames from `begin` to the core of one of its clips.
  std::int64_t to_core(const std::shared_ptr<LiveClip>& clip) const noexcept;
  /// Moves it with all its clips.
  void move_to(std::int64_t frame);
};

/// The same clips, to be shown after nothing.
StepClips without_tail(StepClips clips, bool had_tail);

/// Places the clips after those of a chain, of which frames before `begin` are decided, and makes the frames from there
/// to the end of the last core; to the last retraction if channels differ there; or to the rest. New signs are examined
/// (lint_channels), a rest and lowered hands are not. The clips must be
/// placed as signs (TransitionBuilder::place_sign). The cost depends on the new clips only; steps whose
/// clips all have a key are cached. Throws what `compose_after` throws, Error{bad_input} for more than kMostMade
/// frames.
LaneStep make_step(const ClipChain& chain, std::int64_t begin, const StepClips& clips, StreamSetup& setup, double tempo,
                   StepCache& cache);

}  // namespace signweave
