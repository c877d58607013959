#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "signweave/features/duration_fit.h"
#include "tools/gesture_phase.h"

namespace signweave {

/// Definition of one transition of a labelled track.
enum class Between {
  strokes,       ///< from the end of a stroke to the begin of the next: preparation, retraction and hold, no rest
  movements,     ///< a run of preparation and retraction, whatever the phases around it
  preparations,  ///< the same for preparation alone
};

/// The transitions of some tracks, each with a task measured at its borders alone. A time step of more than kTornStep
/// ends a track. `recording` numbers the users.
std::vector<TimedTransition> transitions_of(std::span<const LabelledTrack> tracks, Between what);
inline constexpr Seconds kTornStep{0.2};

/// Mean absolute errors with one user left out.
struct DurationScores {
  std::size_t count = 0;
  Seconds mean{0};        ///< prediction: the mean of the other users
  Seconds median{0};      ///< prediction: their median
  Seconds log_linear{0};  ///< least squares of the log duration on the log distance and both speeds
  Seconds fitted{0};      ///< fit_durations
};
DurationScores score_users_left_out(std::span<const TimedTransition> transitions);

/// When the hand that moves less begins and ends its movement, relative to the other hand. Medians over movements in
/// which both hands clearly move, one of them at most half as far as the other.
struct HandLags {
  std::size_t count = 0;
  Seconds begin{0};
  Seconds end{0};
  Seconds begin_spread{0};  ///< half the interquartile range
  Seconds end_spread{0};
};
HandLags hand_lags_of(std::span<const LabelledTrack> tracks);

}  // namespace signweave
