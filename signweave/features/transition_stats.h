#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/core/time.h"

namespace signweave {

/// A recorded transition: what lies between the last stroke of one sign and the first stroke of the next.
struct Transition {
  std::size_t from = 0;         ///< index of the first sign in the list that was looked through
  std::size_t to = 0;           ///< index of the second
  TimeSpan span;                ///< from the end of the last stroke to the begin of the next
  Milliseconds retraction{0};   ///< the first sign's retraction
  Milliseconds preparation{0};  ///< the second sign's preparation
  bool inferred = false;        ///< a sign on either side has no annotated phases, so only the gap is known
};

/// Between signs farther apart than this the hands rested: that is no transition but the end of a Unit. (ours)
inline constexpr Milliseconds kRest{1000};
/// The same between signs whose phases are annotated: there the retraction and the preparation meet, give or take what
/// an annotator leaves open. (ours)
inline constexpr Milliseconds kMeeting{100};
/// Between signs without annotated phases, a gap no longer than this tells nothing: the glosses touch, and the
/// transitions lie inside them. (ours)
inline constexpr Milliseconds kTouching{20};

/// The transitions of one recording: neighbours on one sign tier, both with a stroke, at most kMeeting (kRest where
/// either is inferred) between the end of one sign and the begin of the next. By tier, then time.
std::vector<Transition> transitions_in(std::span<const Sign> signs);

/// Mean and spread of transition durations (the paper, section 5.1, figure 4).
struct TransitionStats {
  std::size_t count = 0;  ///< 0: nothing was measured and every duration below is 0
  bool inferred = false;  ///< from gaps between signs without phases, for want of annotated phases
  Milliseconds mean{0};
  Milliseconds deviation{0};  ///< standard deviation of the population
  Milliseconds median{0};
  Milliseconds percentile_10{0};
  Milliseconds percentile_90{0};
  Milliseconds mean_retraction{0};
  Milliseconds mean_preparation{0};
};

/// Over the annotated transitions where there is one; else over the inferred ones.
TransitionStats summarize(std::span<const Transition> transitions);

}  // namespace signweave
