#pragma once

#include <optional>

#include "signweave/core/time.h"
#include "signweave/database/database.h"
#include "signweave/features/duration_fit.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {

/// How long transitions last.
struct DurationModel {
  /// Given by the user: the same for all.
  std::optional<Milliseconds> fixed;
  /// Where it is not given: told from what the hands have to do, where that tells more than the mean of the corpus.
  /// False: the mean (the paper, section 5.1).
  bool fitted = true;
};

/// For a corpus in which no transition was measured: half a second, reported wherever it is used. (ours)
inline constexpr Milliseconds kUnmeasuredTransition{500};

/// The same for a corpus whose signs have no phases: they hold their own transitions, and what lies between them is
/// short (206 ms on average in continuous DGS). (ours)
inline constexpr Milliseconds kUnphasedTransition{200};

/// What a model tells for a corpus. The mean is that of all its transitions (see TransitionStats); of inferred ones a
/// model that may be fitted takes the median, for some of them are pauses. Costs the same in any corpus.
DurationFit durations_of(const Contents& contents, const semantic_db::Learned& learned, const DurationModel& model);

}  // namespace signweave
