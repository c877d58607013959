#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "signweave/live/player.h"
#include "signweave/live/transition_builder.h"

/// Internal to this module.
namespace signweave {

/// A score that grows at its end: the clips that a stream has shown and will show since its last jump or interruption,
/// each joined to the previous one. Only the last clips of a long one are stored. Used by one thread.
class ClipChain {
 public:
  bool empty() const noexcept { return clips_.empty(); }
  /// The last clip; the next one will be joined to it.
  const std::shared_ptr<LiveClip>& back() const noexcept { return clips_.back(); }

  void clear() noexcept { clips_.clear(); }
  /// Starts a new score with this clip.
  void begin(std::shared_ptr<LiveClip> clip);
  /// Adds a clip that was joined to the last one.
  void add(std::shared_ptr<LiveClip> clip);
  /// Removes all clips after this one; if it is not in the chain, the score starts with it.
  void end_with(const std::shared_ptr<LiveClip>& clip);
  /// Replaces the last clip by a shorter version of it.
  void replace_back(std::shared_ptr<LiveClip> clip);

  /// The score of the last clips, up to output frame `end`; `next` is the frame that is shown next. None if the chain
  /// is empty.
  std::optional<ShownScore> score(const TransitionBuilder& builder, const SourceRef& skeleton, std::int64_t next,
                                  std::int64_t end, std::size_t most_clips) const;

  static constexpr std::size_t kMostClips = Player::kMostScoreClips;

 private:
  std::deque<std::shared_ptr<LiveClip>> clips_;
  std::size_t next_number_ = 0;
};

}  // namespace signweave
