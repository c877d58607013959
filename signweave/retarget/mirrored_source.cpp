#include "signweave/retarget/mirrored_source.h"

#include <algorithm>
#include <utility>

namespace signweave {
namespace {

/// Number of frames read at a time.
constexpr std::int64_t kMirroredAtOnce = 32;

}  // namespace

MirroredSource::MirroredSource(std::shared_ptr<const MotionSource> source, std::shared_ptr<const Mirroring> mirroring)
    : source_(std::move(source)),
      mirroring_(std::move(mirroring)),
      tracks_(mirrored_tracks(source_->tracks())),
      mirrorer_(*mirroring_),
      wanted_(tracks_.size()) {
  for (const MirroredTrack& track : tracks_) names_.push_back(track.name);
  captured_.reset(source_->skeleton(), source_->rate(), kMirroredAtOnce);
}

void MirroredSource::read(FrameRange frames, MutablePoses out) const {
  const std::size_t joints = skeleton()->joint_count();
  const std::size_t moved = skeleton()->translation_count();
  for (std::int64_t begin = frames.begin; begin < frames.end; begin += kMirroredAtOnce) {
    const std::int64_t count = std::min(kMirroredAtOnce, frames.end - begin);
    source_->read({begin, begin + count}, captured_.poses({0, count}));
    for (std::int64_t i = 0; i < count; ++i) {
      const auto place = static_cast<std::size_t>(begin + i - frames.begin);
      mirrorer_.pose(std::as_const(captured_).pose(i),
                     {out.rotations.subspan(place * joints, joints), out.translations.subspan(place * moved, moved)});
    }
  }
}

void MirroredSource::read_tracks(FrameRange frames, std::span<const std::span<float>> out) const {
  std::ranges::fill(wanted_, std::span<float>());
  for (std::size_t i = 0; i < out.size(); ++i) wanted_[tracks_[i].from] = out[i];
  source_->read_tracks(frames, wanted_);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (tracks_[i].sign == 1) continue;
    for (float& value : out[i]) value *= tracks_[i].sign;
  }
}

}  // namespace signweave
