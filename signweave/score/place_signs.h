#pragma once

#include <vector>

#include "signweave/score/motion_clip.h"
#include "signweave/score/result.h"

namespace signweave {

/// Fills `out.signs`: the signs of the clips and their phases in output time. In a lane, one sign ends and the next
/// begins in the middle of the generated frames between two strokes. Everything else in `out` must be filled already.
void place_signs(const std::vector<MotionClip>& clips, Synthesis& out);

}  // namespace signweave
