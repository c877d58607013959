#pragma once

#include <optional>
#include <span>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/database/database.h"
#include "signweave/rig/part.h"
#include "signweave/score/motion_clip.h"

namespace signweave {

/// Marks the clips as mirrored whose signers' dominant hand is another than the one in `hands`, [clip]; none: any. A
/// signer whose dominant hand is unknown counts as right-handed, with a notice.
void mark_mirrored(std::span<MotionClip> clips, std::span<const std::optional<Side>> hands, const Snapshot& snapshot,
                   std::vector<Notice>& notices);

/// Mirrors the clips that are marked as mirrored, frame by frame when they are read; each recording is examined once.
/// Adds the messages of each mirroring to `notices`. Throws Error{bad_input} for a signer
/// that cannot be mirrored (mirroring_of).
void mirror_marked(std::span<MotionClip> clips, const Snapshot& snapshot, std::vector<Notice>& notices);

}  // namespace signweave
