#include "signweave/choose/standing.h"

#include <algorithm>

namespace signweave {

bool is_aligned(Alignment alignment, const std::string& recording, const std::string& reference) noexcept {
  return alignment == Alignment::ground || (alignment == Alignment::automatic && recording != reference);
}

Standing standing_of(const PlacedClip& placed, const JunctionSettings& settings, Motion& memory) {
  const FrameRange frames{0, std::min(placed.core_frames, kStandingFrames)};
  PlacedClip alone = placed;
  alone.core = 0;
  memory.reset(settings.skeleton, settings.rate, frames.size());
  read_frames(alone, frames, memory.poses(frames));
  return standing_over(memory, frames);
}

}  // namespace signweave
