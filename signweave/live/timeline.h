#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "signweave/live/frame_ring.h"
#include "signweave/live/transition_builder.h"

/// Internal to this module.
namespace signweave {

/// The known frames of a player: frames of clips, and generated transitions. It grows and is truncated at its end. Used
/// by one thread.
class Timeline {
 public:
  /// One past the last known frame.
  std::int64_t end() const noexcept { return end_; }
  /// Appends frames of a clip, or the last frames of a transition.
  void append(FrameRange frames, const std::shared_ptr<LiveClip>& clip);
  void append(FrameRange frames, std::shared_ptr<const Motion> made);
  /// Appends frames of a motion that begins at output frame `begin`.
  void append(FrameRange frames, std::shared_ptr<const Motion> made, std::int64_t begin);
  /// Removes everything from `end` on.
  void cut(std::int64_t end) noexcept;
  /// Removes everything; the next frame is `next`.
  void restart(std::int64_t next) noexcept;
  /// Drops the frames before `taken`.
  void forget(std::int64_t taken) noexcept;

  /// Replaces a clip by another one in the same position.
  void replace(const std::shared_ptr<LiveClip>& clip, const std::shared_ptr<LiveClip>& by) noexcept;

  /// The clip shown at a frame, or null.
  std::shared_ptr<LiveClip> clip_at(std::int64_t frame) const noexcept;
  /// The end of the run of frames from the same source as `frame`; `frame` if it is not known.
  std::int64_t end_of_same(std::int64_t frame) const noexcept;
  /// Appends frames, all from one source, to the ring. Throws Error{corrupt}.
  void read(FrameRange frames, const TransitionBuilder& builder, FrameRing& ring);

 private:
  /// A run of frames from one source.
  struct Run {
    FrameRange frames;
    std::shared_ptr<LiveClip> clip;      ///< captured frames of it, or
    std::shared_ptr<const Motion> made;  ///< a transition that begins at `made_begin`
    std::int64_t made_begin = 0;
  };
  const Run* run_at(std::int64_t frame) const noexcept;

  std::deque<Run> runs_;
  std::int64_t end_ = 0;
  std::vector<float> track_values_;
  std::vector<std::span<float>> track_spans_;
};

}  // namespace signweave
