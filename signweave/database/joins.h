#pragma once

#include <memory>
#include <string>
#include <vector>

#include "signweave/features/capture_noise.h"
#include "signweave/features/join.h"
#include "signweave/semantic_db/segments.h"

namespace signweave {

class Snapshot;

/// What is known of one sign's joins and of its strokes, from the features of its phases.
struct SignJoin {
  RowId row = kNoRow;        ///< of the sign, in Contents::segments
  JoinPoint begin;           ///< at the first stroke's first frame
  JoinPoint end;             ///< at the last stroke's last frame
  float stroke_seconds = 0;  ///< from the first stroke's begin to the last one's end; 0: it has no stroke
  float path = 0;            ///< metres, of both hands over the same
};

/// The same of every sign of a recording.
struct RecordingJoins {
  std::string why_not;                        ///< empty, or why nothing is known
  std::vector<SignJoin> signs;                ///< ascending by row
  std::shared_ptr<const CaptureNoise> noise;  ///< of its motion; null: not known

  /// Of one sign, or null where there is none of this row.
  const SignJoin* find(RowId row) const noexcept;
};

/// The sign row of the same tier that goes on to this one: the nearest before it, less than kRest away. kNoRow where
/// there is none.
RowId neighbour_before(const Segments& segments, RowId sign) noexcept;

/// The one that goes on from this one, likewise.
RowId neighbour_after(const Segments& segments, RowId sign) noexcept;

/// What the corpus teaches of joins, from 256 recordings and 1,024 pairs of neighbours at most, evenly from all: those
/// that were recorded one after the other are to be told from others. A recorded pair is judged as if it were not known
/// to be one.
JoinWeights learn_joins(const Snapshot& snapshot);

}  // namespace signweave
