#pragma once

#include "signweave/transition/method.h"

/// Inside this module only.
namespace signweave {

/// Takes the capture's noise out of what was seen of both sides of a gap (see_all): a quadratic is fitted to each
/// joint's samples, and velocity, curvature and what is left are each taken times 1 − kShrink · noise / square, at
/// least 0, where `noise` is what Gap::noise_before and noise_after alone would make of its square (James and Stein
/// 1961). So what a capture without noise shows stays as it is, and what noise alone would show is dropped.
///
/// The borders are moved with it. What they are moved by is left in `scratch.offsets`: a curve must fade it out, so
/// that it meets the captured frames. False where nothing was changed, and there are no offsets.
bool quieten(const GapJob& job);

/// How much of an offset is left at a moment, so many seconds from its border.
float offset_left(double seconds, double gap) noexcept;

}  // namespace signweave
