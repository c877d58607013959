#pragma once

#include <vector>

#include "signweave/synthesis/laid.h"

/// Inside this module only.
namespace signweave {

/// Adds to `motion`, which has its frames already, every scalar track that one of the stretches has. The memory of
/// `used` is used again.
void carry_tracks(const std::vector<Laid>& laid, std::vector<ScalarTrack> used, Motion& motion);

}  // namespace signweave
