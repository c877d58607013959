#pragma once

#include <optional>

#include "signweave/core/time.h"
#include "signweave/database/database.h"
#include "signweave/features/duration_fit.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {

/// Options for the duration of transitions.
struct DurationModel {
  /// Set by the user: the same for all.
  std::optional<Milliseconds> fixed;
  /// If `fixed` is not set: predict it from the movement of the hands, if that predicts better than the corpus mean.
  /// False: use the mean (the paper, section 5.1).
  bool fitted = true;
};

/// Used for a corpus without measured transitions, and reported whenever it is used. (ours)
inline constexpr Milliseconds kUnmeasuredTransition{500};

/// The same for a corpus whose signs have no phases: signs then contain their transitions, and the gaps between them
/// are short (206 ms on average in continuous DGS). (ours)
inline constexpr Milliseconds kUnphasedTransition{200};

/// The durations for a corpus. The mean is that of all its transitions (see TransitionStats); for inferred transitions
/// a fitted model uses the median, because some of them are pauses. The cost does not depend on the corpus's size.
DurationFit durations_of(const Contents& contents, const semantic_db::Learned& learned, const DurationModel& model);

}  // namespace signweave
