#pragma once

#include <memory>
#include <string>
#include <vector>

#include "signweave/features/capture_noise.h"
#include "signweave/features/join.h"
#include "signweave/semantic_db/segments.h"

namespace signweave {

class Snapshot;

/// The joins and the strokes of one sign, from the features of its phases.
struct SignJoin {
  RowId row = kNoRow;        ///< of the sign, in Contents::segments
  JoinPoint begin;           ///< at the first stroke's first frame
  JoinPoint end;             ///< at the last stroke's last frame
  float stroke_seconds = 0;  ///< from the begin of the first stroke to the end of the last; 0: no stroke
  float path = 0;            ///< metres, of both hands in the same span
};

/// The joins of every sign of a recording.
struct RecordingJoins {
  std::string why_not;                        ///< why the joins are unknown; empty: they are known
  std::vector<SignJoin> signs;                ///< ascending by row
  std::shared_ptr<const CaptureNoise> noise;  ///< of its motion; null: unknown

  /// Returns the joins of one sign, or null if no sign has this row.
  const SignJoin* find(RowId row) const noexcept;
};

/// Returns the sign row of the same tier that continues to this one: the nearest before it, less than kRest away;
/// kNoRow if there is none.
RowId neighbour_before(const Segments& segments, RowId sign) noexcept;

/// Returns the sign row that this one continues to, likewise.
RowId neighbour_after(const Segments& segments, RowId sign) noexcept;

/// Learns weights of joins that distinguish pairs recorded one after the other from other pairs: from at most 256
/// recordings and 1,024 neighbouring pairs, evenly spread over the corpus. A recorded pair is evaluated as if it were
/// not known to be one.
JoinWeights learn_joins(const Snapshot& snapshot);

}  // namespace signweave
