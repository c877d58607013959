#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/motion/motion.h"

namespace signweave {

/// A source of frames: a motion in memory or a stored one. Frames are read directly into the caller's memory.
/// Quaternions stay in one hemisphere from frame to frame (see keep_hemisphere).
class MotionSource {
 public:
  virtual ~MotionSource() = default;

  virtual const std::shared_ptr<const Skeleton>& skeleton() const noexcept = 0;
  virtual FrameRate rate() const noexcept = 0;
  virtual std::int64_t frame_count() const noexcept = 0;
  /// Names of the scalar tracks.
  virtual std::span<const std::string> tracks() const noexcept = 0;

  /// Copies frames, which must lie within the motion, to `out`, whose size must match. Throws Error{corrupt} if the
  /// stored data is damaged.
  virtual void read(FrameRange frames, MutablePoses out) const = 0;
  /// The same for the scalar tracks: one span per track, in the order of `tracks()`; a track with an empty span is
  /// skipped.
  virtual void read_tracks(FrameRange frames, std::span<const std::span<float>> out) const = 0;
};

/// A motion in memory, not owned, whose quaternions already keep their hemisphere.
class BorrowedSource : public MotionSource {
 public:
  /// The motion must outlive the source and must not change.
  explicit BorrowedSource(const Motion& motion);

  const std::shared_ptr<const Skeleton>& skeleton() const noexcept override { return motion_.shared_skeleton(); }
  FrameRate rate() const noexcept override { return motion_.rate(); }
  std::int64_t frame_count() const noexcept override { return motion_.frame_count(); }
  std::span<const std::string> tracks() const noexcept override { return tracks_; }
  void read(FrameRange frames, MutablePoses out) const override;
  void read_tracks(FrameRange frames, std::span<const std::span<float>> out) const override;

 private:
  const Motion& motion_;
  std::vector<std::string> tracks_;
};

/// A motion in memory, owned.
class MemorySource : public MotionSource {
 public:
  /// Flips the signs of quaternions as keep_hemisphere does.
  explicit MemorySource(Motion motion);
  MemorySource(const MemorySource&) = delete;
  MemorySource& operator=(const MemorySource&) = delete;

  const Motion& motion() const noexcept { return motion_; }
  const std::shared_ptr<const Skeleton>& skeleton() const noexcept override { return borrowed_.skeleton(); }
  FrameRate rate() const noexcept override { return borrowed_.rate(); }
  std::int64_t frame_count() const noexcept override { return borrowed_.frame_count(); }
  std::span<const std::string> tracks() const noexcept override { return borrowed_.tracks(); }
  void read(FrameRange frames, MutablePoses out) const override { borrowed_.read(frames, out); }
  void read_tracks(FrameRange frames, std::span<const std::span<float>> out) const override {
    borrowed_.read_tracks(frames, out);
  }

 private:
  Motion motion_;
  BorrowedSource borrowed_;  ///< refers to motion_
};

}  // namespace signweave
