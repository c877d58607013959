#pragma once

#include <cstdint>
#include <optional>

#include "signweave/core/time.h"
#include "signweave/database/database.h"
#include "signweave/transition/duration.h"

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

/// A fit looks at no more of a corpus: evenly spread, so that it costs the same in a large one.
inline constexpr std::size_t kMostFittedRecordings = 24;
inline constexpr std::size_t kMostFittedTransitions = 400;

/// The transitions of a corpus whose signs have annotated phases, with what the hands had to do in them. A recording
/// whose features are damaged is left out.
std::vector<TimedTransition> timed_transitions(const Database& database, const Contents& contents);

/// What a model tells for a corpus. The mean is that of all its transitions (see TransitionStats); of inferred ones a
/// model that may be fitted takes the median, for some of them are pauses.
DurationFit durations_of(const Database& database, const Contents& contents, const DurationModel& model);

}  // namespace signweave
