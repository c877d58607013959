#pragma once

#include <span>
#include <string>
#include <vector>

#include "signweave/render/laid.h"

namespace signweave {

/// Names of the scalar tracks that any of the stretches has, each once, in the order of the stretches.
std::vector<std::string> tracks_of(std::span<const Laid> laid);

/// Fills the named tracks, each with the values of the output frames of `window`, from stretches that follow each
/// other. Of the window every frame between the cuts, and one on each side, must lie in it.
void carry_tracks(std::span<const Laid> laid, FrameRange window, std::vector<ScalarTrack>& tracks);

}  // namespace signweave
