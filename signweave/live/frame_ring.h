#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "signweave/core/prefetch.h"
#include "signweave/live/frame_codec.h"
#include "signweave/motion/motion.h"

namespace signweave {

/// The last frames of a growing sequence, with their tracks, in memory that is allocated once. Frames are numbered;
/// those in [begin(), end()) are stored.
class FrameRing {
 public:
  FrameRing() = default;
  FrameRing(const FrameShape& shape, std::size_t capacity)
      : shape_(shape),
        capacity_(static_cast<std::int64_t>(capacity)),
        rotations_(capacity * shape.joints),
        translations_(capacity * shape.translations),
        tracks_(capacity * shape.tracks) {}

  std::int64_t begin() const noexcept { return begin_; }
  std::int64_t end() const noexcept { return end_; }
  std::int64_t capacity() const noexcept { return capacity_; }

  /// A stored frame. Borrowed until it is dropped.
  FrameView at(std::int64_t frame) const noexcept {
    assert(frame >= begin_ && frame < end_);
    const std::size_t slot = slot_of(frame);
    return {{std::span(rotations_).subspan(slot * shape_.joints, shape_.joints),
             std::span(translations_).subspan(slot * shape_.translations, shape_.translations)},
            std::span(tracks_).subspan(slot * shape_.tracks, shape_.tracks)};
  }

  /// Prefetches the memory of at(frame).
  void prefetch_frame(std::int64_t frame) const noexcept {
    if (frame < begin_ || frame >= end_) return;
    const FrameView view = at(frame);
    prefetch(view.pose.rotations.data(), view.pose.rotations.size_bytes());
    prefetch(view.pose.translations.data(), view.pose.translations.size_bytes());
    prefetch(view.tracks.data(), view.tracks.size_bytes());
  }

  /// Number of contiguous free frames after end(), at most `most`.
  std::int64_t room(std::int64_t most) const noexcept {
    const std::int64_t free = capacity_ - (end_ - begin_);
    const std::int64_t until_wrap = capacity_ - static_cast<std::int64_t>(slot_of(end_));
    return std::min({most, free, until_wrap});
  }
  /// Memory of the next `count` frames; `count` is at most room().
  MutablePoses poses(std::int64_t count) noexcept {
    const std::size_t slot = slot_of(end_);
    const auto frames = static_cast<std::size_t>(count);
    return {std::span(rotations_).subspan(slot * shape_.joints, frames * shape_.joints),
            std::span(translations_).subspan(slot * shape_.translations, frames * shape_.translations)};
  }
  /// [track] values of frame end() + `ahead`, which must have room.
  std::span<float> tracks(std::int64_t ahead) noexcept {
    return std::span(tracks_).subspan(slot_of(end_ + ahead) * shape_.tracks, shape_.tracks);
  }
  /// Adds `count` frames, whose memory has been filled.
  void grow(std::int64_t count) noexcept { end_ += count; }
  /// Drops the frames before `before`.
  void forget(std::int64_t before) noexcept { begin_ = std::clamp(before, begin_, end_); }
  /// Removes the frames from `from` on.
  void cut(std::int64_t from) noexcept { end_ = std::clamp(from, begin_, end_); }

 private:
  std::size_t slot_of(std::int64_t frame) const noexcept { return static_cast<std::size_t>(frame % capacity_); }

  FrameShape shape_;
  std::int64_t capacity_ = 1;
  std::int64_t begin_ = 0;
  std::int64_t end_ = 0;
  std::vector<Eigen::Quaternionf> rotations_;  ///< [slot][joint]
  std::vector<Eigen::Vector3f> translations_;  ///< [slot][translated joint]
  std::vector<float> tracks_;                  ///< [slot][track]
};

}  // namespace signweave
