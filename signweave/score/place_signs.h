#pragma once

#include <vector>

#include "signweave/score/motion_clip.h"
#include "signweave/score/result.h"

namespace signweave {

/// Fills `out.signs`: where the signs of the clips, and their phases, lie in output time. What is made between two
/// strokes is shared in its middle; there one sign ends and the next begins. Everything else in `out` must be there.
void place_signs(const std::vector<MotionClip>& clips, Synthesis& out);

}  // namespace signweave
