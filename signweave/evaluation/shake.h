#pragma once

#include <cstdint>

#include "signweave/evaluation/evaluation.h"

namespace signweave {

/// Adds noise, as of a poor capture, to the frames next to the spans of a recording, and measures it; the frames that
/// results are compared with stay as captured. White noise rotates each shoulder and elbow in every frame such that the
/// wrist is displaced by `metres` (standard deviation) on each axis across the limb. The same seed gives the same
/// noise.
void shake(EvaluatedMotion& recording, double metres, std::uint64_t seed);

}  // namespace signweave
