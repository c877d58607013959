#pragma once

#include <vector>

#include "signweave/choose/channel_clips.h"
#include "signweave/choose/concatenate.h"

namespace signweave {

/// Joins whole-body clips as `concatenate` does, while single channels show other clips or hold poses. Each lane has
/// its own transitions (Algorithm 1 with cut points of its own). The clips' times are the earliest that let every lane
/// have its transitions and that keep the given ties (see schedule.h); where a lane has time left, its last pose is
/// held until its transition begins, or the transition is up to half as long again.
///
/// Clips that continue the one before them (MotionClip::continues) keep the recorded transition. Without parts and such
/// clips, the result is that of `concatenate`. Throws as it does, and Error{bad_input} if parts contradict each
/// other; the message names those that do.
Synthesis compose(const std::vector<MotionClip>& clips, const ChannelParts& parts, const ConcatenateOptions& options,
                  Synthesis used = {});

}  // namespace signweave
