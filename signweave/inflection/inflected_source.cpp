#include "signweave/inflection/inflected_source.h"

#include <algorithm>
#include <utility>

namespace signweave {
namespace {

float smoothstep(float x) noexcept {
  x = std::clamp(x, 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

}  // namespace

InflectedSource::InflectedSource(std::shared_ptr<const MotionSource> source, std::shared_ptr<const SignerRig> rig,
                                 FrameRange core, StrokeChange change)
    : source_(std::move(source)),
      core_(core),
      change_(std::move(change)),
      changer_(*source_->skeleton(), std::move(rig)) {
  for (std::size_t side = 0; side < 2; ++side) {
    if (change_.arms[side]) paths_[side] = PathSpline(change_.arms[side]->path);
  }
  if (!changer_.why_not().empty()) return;
  Pose first(*source_->skeleton());
  source_->read({core_.begin, core_.begin + 1}, {first.rotations, first.translations});
  space_ = changer_.space_of(std::as_const(first).view());
}

float InflectedSource::weight(std::int64_t frame) const noexcept {
  if (frame < core_.begin) {
    return smoothstep(1 - static_cast<float>(core_.begin - frame) /
                              static_cast<float>(std::max<std::int64_t>(change_.before, 1)));
  }
  if (frame >= core_.end) {
    return smoothstep(1 - static_cast<float>(frame - core_.end + 1) /
                              static_cast<float>(std::max<std::int64_t>(change_.after, 1)));
  }
  return 1;
}

void InflectedSource::read(FrameRange frames, MutablePoses out) const {
  source_->read(frames, out);
  if (!changer_.why_not().empty()) return;
  const std::size_t joints = skeleton()->joint_count();
  const std::size_t moved = skeleton()->translation_count();
  const auto last = static_cast<float>(std::max<std::int64_t>(core_.size() - 1, 1));
  for (std::int64_t frame = frames.begin; frame < frames.end; ++frame) {
    const auto place = static_cast<std::size_t>(frame - frames.begin);
    changer_.apply(change_, paths_, space_, weight(frame), static_cast<float>(frame - core_.begin) / last,
                   {out.rotations.subspan(place * joints, joints), out.translations.subspan(place * moved, moved)});
  }
}

}  // namespace signweave
