#pragma once

#include <cstddef>

#include "signweave/database/database.h"
#include "signweave/features/dominance.h"

namespace signweave {

/// Returns the dominant hand of the signer of `contents().recordings[recording]`, from the stored measures of its
/// strokes and the hands of its sign tiers; no frame is read if the measures are current. Unknown without annotation or
/// motion, and if the measures are damaged.
Dominance dominance_of(const Snapshot& snapshot, std::size_t recording);

}  // namespace signweave
