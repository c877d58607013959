#pragma once

#include <vector>

#include "signweave/score/result.h"
#include "signweave/score/stretch.h"

namespace signweave {

/// Fills `out.signs`: where the signs of the stretches, and their phases, lie in output time. What is made between two
/// strokes is shared in its middle; there one sign ends and the next begins. Everything else in `out` must be there.
void place_signs(const std::vector<Stretch>& stretches, Synthesis& out);

}  // namespace signweave
