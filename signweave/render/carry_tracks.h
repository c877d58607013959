#pragma once

#include <span>
#include <vector>

#include "signweave/render/laid.h"

namespace signweave {

/// Adds to `motion`, which has its frames already, every scalar track that one of the stretches has. The memory of
/// `used` is used again.
void carry_tracks(const std::vector<Laid>& laid, std::vector<ScalarTrack> used, Motion& motion);

/// Fills the named tracks, each with the values of the output frames of `window`, from stretches that follow each
/// other. Of the window every frame between the cuts, and one on each side, must lie in it.
void carry_tracks(std::span<const Laid> laid, FrameRange window, std::vector<ScalarTrack>& tracks);

}  // namespace signweave
