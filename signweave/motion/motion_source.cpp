#include "signweave/motion/motion_source.h"

#include <algorithm>
#include <cassert>

namespace signweave {

BorrowedSource::BorrowedSource(const Motion& motion) : motion_(motion) {
  for (const ScalarTrack& track : motion_.tracks()) tracks_.push_back(track.name);
}

MemorySource::MemorySource(Motion motion) : motion_(std::move(motion)), borrowed_(motion_) {
  if (!keeps_hemisphere(motion_)) keep_hemisphere(motion_);
}

void BorrowedSource::read(FrameRange frames, MutablePoses out) const {
  assert(frames.begin >= 0 && frames.end <= motion_.frame_count());
  const auto at = static_cast<std::size_t>(frames.begin);
  const std::size_t joints = motion_.skeleton().joint_count();
  const std::size_t moved = motion_.skeleton().translation_count();
  std::ranges::copy(motion_.rotations().subspan(at * joints, out.rotations.size()), out.rotations.begin());
  std::ranges::copy(motion_.translations().subspan(at * moved, out.translations.size()), out.translations.begin());
}

void BorrowedSource::read_tracks(FrameRange frames, std::span<const std::span<float>> out) const {
  for (std::size_t track = 0; track < out.size(); ++track) {
    if (out[track].empty()) continue;
    const std::vector<float>& values = motion_.tracks()[track].values;
    std::copy(values.begin() + frames.begin, values.begin() + frames.end, out[track].begin());
  }
}

}  // namespace signweave
