#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "signweave/live/frame_ring.h"
#include "signweave/live/transition_builder.h"

/// Inside this module only.
namespace signweave {

/// Which frames a player shows, as far as that is known: frames of clips, and transitions that were made. It grows at
/// its end, and is taken back there. Belongs to one thread.
class Timeline {
 public:
  /// It is known up to this frame.
  std::int64_t end() const noexcept { return end_; }
  /// Its next frames: those of a clip, or the last ones of a transition.
  void append(FrameRange frames, const std::shared_ptr<LiveClip>& clip);
  void append(FrameRange frames, std::shared_ptr<const Motion> made);
  /// What begins at `end` or later is not shown after all.
  void cut(std::int64_t end) noexcept;
  /// Nothing is known; the next frame is `next`.
  void begin_anew(std::int64_t next) noexcept;
  /// Frames before that one are not needed again.
  void forget(std::int64_t taken) noexcept;

  /// What is shown of a clip is from now on of another one, which lies as it does.
  void replace(const std::shared_ptr<LiveClip>& clip, const std::shared_ptr<LiveClip>& by) noexcept;

  /// The clip of which a frame is shown, or null.
  std::shared_ptr<LiveClip> clip_at(std::int64_t frame) const noexcept;
  /// The frame after those that are shown from the same thing as `frame`; `frame` where that is not known.
  std::int64_t end_of_same(std::int64_t frame) const noexcept;
  /// Puts frames, all from one thing, behind the ring's last one. Throws Error{corrupt}.
  void read(FrameRange frames, const TransitionBuilder& builder, FrameRing& ring);

 private:
  /// Frames that are all from one thing.
  struct Segment {
    FrameRange frames;
    std::shared_ptr<LiveClip> clip;      ///< captured frames of it, or
    std::shared_ptr<const Motion> made;  ///< a transition that begins at `made_begin`
    std::int64_t made_begin = 0;
  };
  const Segment* segment_at(std::int64_t frame) const noexcept;

  std::deque<Segment> segments_;
  std::int64_t end_ = 0;
  std::vector<float> track_values_;
  std::vector<std::span<float>> track_spans_;
};

}  // namespace signweave
