#pragma once

#include <cstddef>
#include <span>

#include "signweave/render/junction.h"
#include "signweave/render/placed_clip.h"

/// What every renderer of clips does, of a whole score as of a piece of one: clips that follow each other are read into
/// a window of output frames and joined there.
namespace signweave {

/// Output frames of a clip that the one before it, or null, has not.
FrameRange own_frames(const PlacedClip* before, const PlacedClip& placed) noexcept;

/// Output frames of a clip, brought to where the signer stands. Throws Error{corrupt}.
void read_standing(const PlacedClip& placed, const Skeleton& skeleton, FrameRange output, MutablePoses out);

/// Puts the captured frames of clips into a window: of each those that the one before it has not. They stand where
/// they were captured. Throws Error{corrupt}.
void fetch(std::span<const PlacedClip> clips, OutputWindow window);

/// Clips in one window, with the cuts of the junction before each but the first.
struct JoinedClips {
  std::span<const PlacedClip> clips;
  std::span<const JunctionCuts> cuts;  ///< [clip − 1]
  /// Joints of the first clip whose quaternions are turned, as the clips before it leave them; null: none.
  const JointSigns* turned = nullptr;
};

/// Brings the frames that `fetch` put into a window to where the signer stands, and makes the transitions between
/// them. Of each transition the window must have the frames beside it that JunctionFiller::fill asks for. Throws
/// Error{corrupt}.
void join(const JoinedClips& joined, JunctionFiller& filler, OutputWindow window, JunctionScratch& scratch);

}  // namespace signweave
