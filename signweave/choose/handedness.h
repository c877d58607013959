#pragma once

#include <vector>

#include "signweave/core/error.h"
#include "signweave/database/database.h"
#include "signweave/rig/part.h"
#include "signweave/score/motion_clip.h"

namespace signweave {

/// Mirrors the clips of signers whose dominant hand is not `hand`, so that all sign with that hand. A signer whose
/// dominant hand is unknown counts as right-handed, with a notice. Throws Error{bad_input} for a signer that cannot be
/// mirrored (mirroring_of).
void show_handedness(std::vector<MotionClip>& clips, Side hand, const Snapshot& snapshot, std::vector<Notice>& notices);

/// Mirrors the clips that are marked as mirrored, frame by frame when they are read; each recording is examined once.
/// Adds the messages of each mirroring to `notices`. Throws likewise.
void mirror_marked(std::vector<MotionClip>& clips, const Contents& contents, std::vector<Notice>& notices);

}  // namespace signweave
