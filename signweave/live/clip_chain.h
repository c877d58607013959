#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "signweave/live/player.h"
#include "signweave/live/transition_builder.h"

/// Internal to this module.
namespace signweave {

/// A clip in a lane of a stream, with the transition after it.
struct LiveLink {
  std::shared_ptr<LiveClip> clip;
  std::int64_t held = 0;  ///< output frames for which its last pose is held after its core
  /// The clip of the body until whose end it is held; null: it is not held, or only until the transition begins.
  std::shared_ptr<LiveClip> held_until = nullptr;
  TransitionCut cut = {};  ///< of the transition to the next link
  std::optional<HandPlace> place = {};
};
/// What each channel shows, [Channel]. A part of another channel shows what that one does, or has clips of its own.
using LiveLanes = std::array<std::deque<LiveLink>, kAllChannels.size()>;

/// A score that grows at its end: the clips that a stream has shown and will show since its last jump or interruption,
/// each joined to the previous one. Only the last clips of a long one are stored. Used by one thread.
class ClipChain {
 public:
  bool empty() const noexcept { return body().empty(); }
  /// The last clip of the body; the next one will be joined to it.
  const std::shared_ptr<LiveClip>& back() const noexcept { return body().back().clip; }
  /// What a channel shows.
  const std::deque<LiveLink>& lane(Channel channel) const noexcept { return lanes_[static_cast<std::size_t>(channel)]; }
  /// True if all channels show the last clip of the body.
  bool is_uniform() const noexcept;
  /// The output frame from which on a channel shows the next clip, or a transition to it.
  std::int64_t core_end() const noexcept;

  void clear() noexcept;
  /// Starts a new score with this clip.
  void begin(std::shared_ptr<LiveClip> clip);
  /// Adds a clip that was joined to the last one.
  void add(std::shared_ptr<LiveClip> clip);
  /// Adds links of each channel. The first one replaces a link of the same clip, if there is one, and all after it.
  /// Clips that the body does not show have the number of the first one that it shows next.
  void add(const LiveLanes& links);
  /// Removes all clips that were added after this one; if it is not in the chain, the score starts with it.
  void end_with(const std::shared_ptr<LiveClip>& clip);
  /// Replaces the last clip by a shorter version of it.
  void replace_back(std::shared_ptr<LiveClip> clip);

  /// The score of the last clips, up to output frame `end`; `next` is the frame that is shown next. None if the chain
  /// is empty.
  std::optional<ShownScore> score(const TransitionBuilder& builder, const SourceRef& skeleton, std::int64_t next,
                                  std::int64_t end, std::size_t most_clips) const;

  static constexpr std::size_t kMostClips = Player::kMostScoreClips;

 private:
  std::deque<LiveLink>& body() noexcept { return lanes_.front(); }
  const std::deque<LiveLink>& body() const noexcept { return lanes_.front(); }
  void number(LiveClip& clip);
  void forget();

  LiveLanes lanes_;
  std::size_t next_number_ = 0;
};

}  // namespace signweave
