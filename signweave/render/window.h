#pragma once

#include <cstddef>
#include <span>

#include "signweave/render/junction.h"
#include "signweave/render/placed_clip.h"

/// Steps common to all renderers of clips, for a whole score or a part of it: consecutive clips are read into a window
/// of output frames and joined there.
namespace signweave {

/// The part of some frames that lies in a window.
FrameRange inside(FrameRange frames, FrameRange window) noexcept;

/// Output frames of a clip that do not belong to the previous clip (which may be null).
FrameRange own_frames(const PlacedClip* before, const PlacedClip& placed) noexcept;

/// Reads output frames of a clip, moved to where the signer stands. Throws Error{corrupt}.
void read_standing(const PlacedClip& placed, const Skeleton& skeleton, FrameRange output, MutablePoses out);

/// Reads the captured frames of clips into a window, for each clip those that the previous one does not have. The
/// signer stays where captured. Throws Error{corrupt}.
void fetch(std::span<const PlacedClip> clips, OutputWindow window);

/// Clips in one window, with the cuts of the junction before each except the first.
struct JoinedClips {
  std::span<const PlacedClip> clips;
  std::span<const JunctionCuts> cuts;  ///< [clip − 1]
  /// Joints of the first clip whose quaternions are negated because of the clips before it; null: none.
  const JointSigns* turned = nullptr;
};

/// Moves the frames that `fetch` read into a window to where the signer stands, and makes the transitions between them.
/// The window must contain the frames next to each transition that JunctionFiller::fill requires. Throws
/// Error{corrupt}.
void join(const JoinedClips& joined, JunctionFiller& filler, OutputWindow window, JunctionScratch& scratch);

}  // namespace signweave
