#pragma once

#include <cstdint>
#include <span>

#include "signweave/query/movement.h"
#include "signweave/query/movement_term.h"
#include "signweave/query/phase_query.h"

/// Internal to this module: the values of scalar tracks and the gaze over a segment.
namespace signweave {

/// The value of a term on a scalar track or the gaze (is_series) over the spans of a row in order: maximum, minimum or
/// mean of all frames, or the value of the first or last. kNotKnown if there is no span, a span lies outside the
/// motion, the recording has no such track or gaze, or a value is not finite. Throws what `movement` throws.
float series_over(const MovementTerm& term, const Movement& movement, std::uint32_t recording,
                  std::span<const TimeSpan> spans);

/// Throws Error{not_found} with near matches if a condition of the query is on a scalar track that no recording has.
void require_tracks(const PhaseQuery& query, const Movement& movement);

}  // namespace signweave
