#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "signweave/live/player.h"
#include "signweave/live/transition_builder.h"

/// Inside this module only.
namespace signweave {

/// A score that grows at its end: the clips that a stream showed and will show, each joined to the one before it, since
/// it last jumped or was interrupted. Of a long one the first clips are left out. Belongs to one thread.
class ClipChain {
 public:
  bool empty() const noexcept { return clips_.empty(); }
  /// The last clip; the next one is joined to it.
  const std::shared_ptr<LiveClip>& back() const noexcept { return clips_.back(); }

  void clear() noexcept { clips_.clear(); }
  /// A new score that begins with that clip.
  void begin(std::shared_ptr<LiveClip> clip);
  /// A clip that was joined to the last one.
  void add(std::shared_ptr<LiveClip> clip);
  /// Leaves out all clips after that one; where it is none of them, the score begins with it.
  void end_with(const std::shared_ptr<LiveClip>& clip);
  /// The last clip as it is now: shorter than it was.
  void replace_back(std::shared_ptr<LiveClip> clip);

  /// The score up to output frame `end`, of the last clips; `next`: the frame that is shown next. None where nothing
  /// of it is known.
  std::optional<ShownScore> score(const TransitionBuilder& builder, const SourceRef& skeleton, std::int64_t next,
                                  std::int64_t end, std::size_t most_clips) const;

  static constexpr std::size_t kMostClips = Player::kMostScoreClips;

 private:
  std::deque<std::shared_ptr<LiveClip>> clips_;
  std::size_t next_number_ = 0;
};

}  // namespace signweave
