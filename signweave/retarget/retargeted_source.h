#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "signweave/motion/motion_source.h"
#include "signweave/retarget/body_mapping.h"

namespace signweave {

/// A recording's motion retargeted to another's skeleton: frame by frame, with unchanged tracks. A frame is the same
/// whichever frames are read with it, up to the signs of quaternions. Belongs to one thread; reading allocates only
/// what the source's reading allocates.
class RetargetedSource final : public MotionSource {
 public:
  /// `mapping` must be for the source's recording.
  RetargetedSource(std::shared_ptr<const MotionSource> source, std::shared_ptr<const BodyMapping> mapping);

  const BodyMapping& mapping() const noexcept { return *mapping_; }
  const std::shared_ptr<const Skeleton>& skeleton() const noexcept override { return mapping_->skeleton; }
  FrameRate rate() const noexcept override { return source_->rate(); }
  std::int64_t frame_count() const noexcept override { return source_->frame_count(); }
  std::span<const std::string> tracks() const noexcept override { return source_->tracks(); }
  void read(FrameRange frames, MutablePoses out) const override;
  void read_tracks(FrameRange frames, std::span<const std::span<float>> out) const override {
    source_->read_tracks(frames, out);
  }

 private:
  std::shared_ptr<const MotionSource> source_;
  std::shared_ptr<const BodyMapping> mapping_;
  mutable BodyMapper mapper_;
  mutable Motion captured_;
};

}  // namespace signweave
