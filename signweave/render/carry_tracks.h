#pragma once

#include <span>
#include <string>
#include <vector>

#include "signweave/render/placed_clip.h"

namespace signweave {

/// The unique names of the clips' scalar tracks, in the order of the clips.
std::vector<std::string> tracks_of(std::span<const PlacedClip> placed);

/// Fills the named tracks, each with the values of the output frames of `window`, from consecutive clips. The window
/// must contain every frame between the cuts, and one on each side.
void carry_tracks(std::span<const PlacedClip> placed, FrameRange window, std::vector<ScalarTrack>& tracks);

}  // namespace signweave
