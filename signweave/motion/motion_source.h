#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/motion/motion.h"

namespace signweave {

/// Where frames come from: a motion in memory or one that is stored. Reading goes straight to where the frames are
/// wanted. Quaternions keep one hemisphere from frame to frame (see keep_hemisphere).
class MotionSource {
 public:
  virtual ~MotionSource() = default;

  virtual const std::shared_ptr<const Skeleton>& skeleton() const noexcept = 0;
  virtual FrameRate rate() const noexcept = 0;
  virtual std::int64_t frame_count() const noexcept = 0;
  /// Names of the scalar tracks.
  virtual std::span<const std::string> tracks() const noexcept = 0;

  /// Copies frames, which must lie within the motion, to `out`, which must have room for just these.
  /// Throws Error{corrupt} where what is stored is damaged.
  virtual void read(FrameRange frames, MutablePoses out) const = 0;
  /// The same for the scalar tracks: a span for each of them, in the order of `tracks()`; one that is empty is left
  /// out.
  virtual void read_tracks(FrameRange frames, std::span<const std::span<float>> out) const = 0;
};

/// A motion in memory that somebody else keeps, and that has its neighbours in one hemisphere.
class BorrowedSource : public MotionSource {
 public:
  /// The motion must outlive it, and stay as it is.
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

/// A motion in memory.
class MemorySource : public MotionSource {
 public:
  /// Turns the signs of quaternions that leave their hemisphere.
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
  BorrowedSource borrowed_;  ///< of it
};

}  // namespace signweave
