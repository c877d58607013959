#include "signweave/retarget/retargeted_source.h"

#include <algorithm>
#include <utility>

namespace signweave {
namespace {

/// Number of frames read at a time.
constexpr std::int64_t kFramesAtOnce = 32;

}  // namespace

RetargetedSource::RetargetedSource(std::shared_ptr<const MotionSource> source,
                                   std::shared_ptr<const BodyMapping> mapping)
    : source_(std::move(source)), mapping_(std::move(mapping)), mapper_(*mapping_) {
  captured_.reset(source_->skeleton(), source_->rate(), kFramesAtOnce);
}

void RetargetedSource::read(FrameRange frames, MutablePoses out) const {
  const std::size_t joints = mapping_->skeleton->joint_count();
  const std::size_t moved = mapping_->skeleton->translation_count();
  // Quaternion signs follow the previous frame, initially the usual pose, so that a frame mostly has the same sign in
  // every read.
  std::span<const Eigen::Quaternionf> before = mapping_->usual.rotations;
  for (std::int64_t begin = frames.begin; begin < frames.end; begin += kFramesAtOnce) {
    const std::int64_t count = std::min(kFramesAtOnce, frames.end - begin);
    source_->read({begin, begin + count}, captured_.poses({0, count}));
    for (std::int64_t i = 0; i < count; ++i) {
      const auto place = static_cast<std::size_t>(begin + i - frames.begin);
      const std::span<Eigen::Quaternionf> turns = out.rotations.subspan(place * joints, joints);
      mapper_.pose(std::as_const(captured_).pose(i), {turns, out.translations.subspan(place * moved, moved)});
      for (std::size_t joint = 0; joint < joints; ++joint) {
        if (before[joint].dot(turns[joint]) < 0) turns[joint].coeffs() *= -1.0f;
      }
      before = turns;
    }
  }
}

}  // namespace signweave
