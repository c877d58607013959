#pragma once

#include <cstdint>
#include <span>

#include "signweave/query/movement.h"
#include "signweave/query/movement_term.h"
#include "signweave/query/phase_query.h"

/// Inside this module only: what scalar tracks and the gaze are over a segment.
namespace signweave {

/// The number that a term on a scalar track or the gaze (is_series) asks for, over the stretches of a row in order: the
/// most, the least or the mean of all their frames, or that of the first or last. kNotKnown where there is no stretch,
/// one lies outside of the motion, the recording has no such thing, or a value is no finite number. Throws what
/// `movement` does.
float series_over(const MovementTerm& term, const Movement& movement, std::uint32_t recording,
                  std::span<const TimeSpan> stretches);

/// Throws Error{not_found} with near matches where a condition of the query is on a scalar track that no recording has.
void require_tracks(const PhaseQuery& query, const Movement& movement);

}  // namespace signweave
