#pragma once

#include <vector>

#include "signweave/features/duration_fit.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {

class Snapshot;

/// The transitions of a corpus whose signs have annotated phases, with what the hands had to do in them: at most 400,
/// of 24 recordings, evenly from all. A recording whose features are damaged is left out.
std::vector<TimedTransition> timed_transitions(const Snapshot& snapshot);

/// What captured movements teach of transitions: of 24 recordings, a minute of each, and 600 movements at most, evenly
/// from all; compared by leaving out signers where several are known, else recordings. A recording whose motion is
/// damaged is left out.
ResidualModel learn_movements(const Snapshot& snapshot);

/// What a corpus teaches as it is now: see learn_joins, timed_transitions and learn_movements. `changes` is left at 0.
semantic_db::Learned learn_from(const Snapshot& snapshot);

/// True where two say the same, give or take what another compiler rounds otherwise; `changes` is not compared.
bool nearly_same(const semantic_db::Learned& a, const semantic_db::Learned& b) noexcept;

}  // namespace signweave
