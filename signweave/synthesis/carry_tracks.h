#pragma once

#include <vector>

#include "signweave/synthesis/laid.h"

/// Inside this module only.
namespace signweave {

/// Adds to `out.motion` every scalar track that one of the stretches has. Its motion and junctions must be there.
void carry_tracks(const std::vector<Laid>& laid, Synthesis& out);

}  // namespace signweave
