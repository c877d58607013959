#pragma once

#include <span>
#include <string>
#include <vector>

#include "signweave/render/placed_clip.h"

namespace signweave {

/// Names of the scalar tracks that any of the clips has, each once, in the order of the clips.
std::vector<std::string> tracks_of(std::span<const PlacedClip> placed);

/// Fills the named tracks, each with the values of the output frames of `window`, from clips that follow each
/// other. Of the window every frame between the cuts, and one on each side, must lie in it.
void carry_tracks(std::span<const PlacedClip> placed, FrameRange window, std::vector<ScalarTrack>& tracks);

}  // namespace signweave
