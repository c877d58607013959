#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "signweave/features/duration_fit.h"
#include "tools/gesture_phase.h"

namespace signweave {

/// What counts as one transition of a labelled track.
enum class Between {
  strokes,       ///< from the end of a stroke to the begin of the next: preparation, retraction and hold, no rest
  movements,     ///< a run of preparation and retraction, from whatever is before it to whatever is after
  preparations,  ///< the same of preparation alone
};

/// The transitions of some tracks, each with a task measured at its borders alone. A step of more than kTornStep ends
/// a track. `recording` numbers the users.
std::vector<TimedTransition> transitions_of(std::span<const LabelledTrack> tracks, Between what);
inline constexpr Seconds kTornStep{0.2};

/// Mean absolute errors with one user left out.
struct DurationScores {
  std::size_t count = 0;
  Seconds mean{0};        ///< the mean of the others is taken
  Seconds median{0};      ///< their median
  Seconds log_linear{0};  ///< least squares of the logarithm in the logarithm of distance, and both speeds
  Seconds fitted{0};      ///< fit_durations
};
DurationScores score_users_left_out(std::span<const TimedTransition> transitions);

/// When the hand that goes less far begins and ends to move, after the other. Medians over movements in which both
/// hands clearly move, one of them at most half as far as the other.
struct HandLags {
  std::size_t count = 0;
  Seconds begin{0};
  Seconds end{0};
  Seconds begin_spread{0};  ///< half of the middle half
  Seconds end_spread{0};
};
HandLags hand_lags_of(std::span<const LabelledTrack> tracks);

}  // namespace signweave
