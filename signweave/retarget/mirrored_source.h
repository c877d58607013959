#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "signweave/motion/motion_source.h"
#include "signweave/retarget/mirrored_tracks.h"
#include "signweave/retarget/mirroring.h"

namespace signweave {

/// A recording's motion mirrored, frame by frame, with its tracks. A frame has the same bits whichever frames are read
/// with it. Belongs to one thread; reading allocates only what the source's reading allocates.
class MirroredSource final : public MotionSource {
 public:
  /// `mirroring` must be for the source's recording.
  MirroredSource(std::shared_ptr<const MotionSource> source, std::shared_ptr<const Mirroring> mirroring);

  const Mirroring& mirroring() const noexcept { return *mirroring_; }
  const std::shared_ptr<const Skeleton>& skeleton() const noexcept override { return source_->skeleton(); }
  FrameRate rate() const noexcept override { return source_->rate(); }
  std::int64_t frame_count() const noexcept override { return source_->frame_count(); }
  std::span<const std::string> tracks() const noexcept override { return names_; }
  void read(FrameRange frames, MutablePoses out) const override;
  void read_tracks(FrameRange frames, std::span<const std::span<float>> out) const override;

 private:
  std::shared_ptr<const MotionSource> source_;
  std::shared_ptr<const Mirroring> mirroring_;
  std::vector<MirroredTrack> tracks_;
  std::vector<std::string> names_;
  mutable Mirrorer mirrorer_;
  mutable Motion captured_;
  mutable std::vector<std::span<float>> wanted_;  ///< [captured track]
};

}  // namespace signweave
