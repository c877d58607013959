#pragma once

#include <cstddef>

#include "signweave/database/database.h"
#include "signweave/features/dominance.h"

namespace signweave {

/// Returns the dominant hand of the signer of `contents().recordings[recording]`, from the stored measures of its
/// strokes and the hands of its sign tiers; no frame is read if the measures are current. Unknown without annotation or
/// motion, and if the measures are damaged.
Dominance dominance_of(const Snapshot& snapshot, std::size_t recording);

/// The hand that signs a sign alone: its palm moves, the other one hardly does (dominance_of). None if both take part,
/// neither moves, or the hands are unknown. `sign` is a row of `contents().segments`.
std::optional<Side> only_hand_of(const Snapshot& snapshot, RowId sign);

}  // namespace signweave
