#pragma once

#include "signweave/transition/method.h"

/// Internal to this module.
namespace signweave {

/// Removes the capture's noise from the samples of both sides of a gap (see_all). A quadratic is fitted to each joint's
/// samples; velocity, curvature and the remainder are each multiplied by max(0, 1 − kShrink · noise / square), where
/// `noise` is the expected square from Gap::noise_before and noise_after alone (James and Stein 1961). So motion of a
/// noise-free capture is unchanged, and motion that noise alone explains is dropped.
///
/// The borders are moved too. Their offsets are stored in `scratch.offsets`; a curve must fade them out so that it
/// meets the captured frames. Returns false if nothing was changed; then there are no offsets.
bool quieten(const GapJob& job);

/// The share of an offset that is left `seconds` after its border.
float offset_left(double seconds, double gap) noexcept;

}  // namespace signweave
