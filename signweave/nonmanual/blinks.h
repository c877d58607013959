#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "signweave/nonmanual/curve.h"

/// Blinks where signers blink: most at prosodic boundaries, some at any time.
namespace signweave {

struct BlinkOptions {
  std::uint64_t seed = 0;      ///< another seed gives other blinks at the same rate
  double per_minute = 12.5;    ///< mean rate; from 0 to 60
  double at_boundaries = 0.7;  ///< share of blinks at boundaries, if there are enough of them (Herrmann 2010)
  Milliseconds spacing{400};   ///< the least time between two blinks
};

/// Two moments of the plan influence each other only within this time. What lies farther before the end of what is
/// known does not change when more becomes known, so a stream plans as a file does.
inline constexpr Milliseconds kBlinkHorizon{700};

/// The moments in `whole` at which the lids are shut, ascending, at least `spacing` apart. `boundaries` (pauses, final
/// lengthenings, ends of brow markers, changes of gaze) and `strokes` are in order of time. A blink at any other moment
/// is moved out of the first third of a stroke if a boundary or an end of that third lies within 300 ms. The same input
/// gives the same moments. Throws Error{bad_input} for options out of range.
std::vector<Milliseconds> plan_blinks(TimeSpan whole, std::span<const Milliseconds> boundaries,
                                      std::span<const TimeSpan> strokes, const BlinkOptions& options = {});

/// A blink that shuts the lids at a moment: 80 ms down, 150 ms up, as at rest (live/living_rest).
TimedCurve blink_at(Milliseconds shut);
/// The output frames of a blink, with the lids shut exactly at the frame nearest to the moment.
FrameRange blink_frames(Milliseconds shut, FrameRate rate) noexcept;

}  // namespace signweave
