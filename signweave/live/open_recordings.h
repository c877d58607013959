#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "signweave/database/database.h"
#include "signweave/motion/motion_source.h"

namespace signweave {

/// Recordings of a database that are read occasionally over a long time. They are opened on reading and closed in
/// between, so that a waiting player holds no database resources. Used by one thread.
class OpenRecordings {
 public:
  explicit OpenRecordings(const Database& database) : database_(database) {}

  const Snapshot& snapshot();
  /// The motion of a recording. Throws Error{conflict} if it was removed since, or replaced by one of another length or
  /// shape; one that was merely stored again is accepted.
  const MotionSource& motion(const std::string& recording, const motion_db::StoredMotion& stored);
  void close() noexcept;

 private:
  const Database& database_;
  std::optional<Snapshot> snapshot_;
  std::map<std::uint64_t, std::unique_ptr<MotionSource>> motions_;  ///< by the requested generation
};

/// One of these recordings as a long-lived source.
class RecordingSource final : public MotionSource {
 public:
  /// `open` must outlive it.
  RecordingSource(OpenRecordings& open, const RecordingInfo& recording);

  const std::shared_ptr<const Skeleton>& skeleton() const noexcept override { return skeleton_; }
  FrameRate rate() const noexcept override { return stored_.rate; }
  std::int64_t frame_count() const noexcept override { return stored_.frames; }
  std::span<const std::string> tracks() const noexcept override { return stored_.tracks; }
  void read(FrameRange frames, MutablePoses out) const override { motion().read(frames, out); }
  void read_tracks(FrameRange frames, std::span<const std::span<float>> out) const override {
    motion().read_tracks(frames, out);
  }

 private:
  const MotionSource& motion() const { return open_.motion(recording_, stored_); }

  OpenRecordings& open_;
  std::string recording_;
  motion_db::StoredMotion stored_;
  std::shared_ptr<const Skeleton> skeleton_;
};

}  // namespace signweave
