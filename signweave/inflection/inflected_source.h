#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>

#include "signweave/inflection/stroke_changer.h"
#include "signweave/motion/motion_source.h"

namespace signweave {

/// A recording's motion in which one stroke is changed in space, frame by frame, with unchanged tracks. The change
/// begins and ends smoothly in the frames before and after the stroke. A frame has the same bits whichever frames are
/// read with it. Belongs to one thread; reading allocates only what the source's reading allocates.
class InflectedSource final : public MotionSource {
 public:
  /// `core` are the stroke's frames of `source`; the change is of the signer of `rig`. Throws Error{corrupt} as `read`.
  InflectedSource(std::shared_ptr<const MotionSource> source, std::shared_ptr<const SignerRig> rig, FrameRange core,
                  StrokeChange change);

  const StrokeChange& change() const noexcept { return change_; }
  const std::shared_ptr<const MotionSource>& captured() const noexcept { return source_; }
  const std::shared_ptr<const Skeleton>& skeleton() const noexcept override { return source_->skeleton(); }
  FrameRate rate() const noexcept override { return source_->rate(); }
  std::int64_t frame_count() const noexcept override { return source_->frame_count(); }
  std::span<const std::string> tracks() const noexcept override { return source_->tracks(); }
  void read(FrameRange frames, MutablePoses out) const override;
  void read_tracks(FrameRange frames, std::span<const std::span<float>> out) const override {
    source_->read_tracks(frames, out);
  }

 private:
  float weight(std::int64_t frame) const noexcept;

  std::shared_ptr<const MotionSource> source_;
  FrameRange core_;
  StrokeChange change_;
  std::array<PathSpline, 2> paths_;
  StrokeSpace space_;
  mutable StrokeChanger changer_;
};

}  // namespace signweave
