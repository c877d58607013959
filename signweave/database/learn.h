#pragma once

#include <vector>

#include "signweave/features/duration_fit.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {

class Snapshot;

/// Returns transitions between signs with annotated phases, and the task of the hands in them: at most 400, from at
/// most 24 recordings, both evenly spread over the corpus. Recordings with damaged features are left out.
std::vector<TimedTransition> timed_transitions(const Snapshot& snapshot);

/// Learns transitions from captured movements: at most 600 in the middle minute of at most 24 recordings, evenly spread
/// over the corpus; cross-validated over signers if several are known, else over recordings. Recordings with damaged
/// motion are left out.
ResidualModel learn_movements(const Snapshot& snapshot);

/// Learns from the corpus in its current state: see learn_joins, timed_transitions and learn_movements. `changes` is 0.
semantic_db::Learned learn_from(const Snapshot& snapshot);

/// True if both are equal up to rounding differences between compilers; `changes` is not compared.
bool nearly_same(const semantic_db::Learned& a, const semantic_db::Learned& b) noexcept;

}  // namespace signweave
