#pragma once

#include <cstdint>

#include "signweave/evaluation/evaluation.h"

namespace signweave {

/// Lets the frames beside the spans of a recording shake, as a poor capture does, and measures that noise; what is
/// compared with stays as captured. White noise turns each shoulder and each elbow in every frame, so that the wrist is
/// off by `metres` on each axis across the limb (standard deviation). The same seed gives the same noise.
void shake(EvaluatedMotion& recording, double metres, std::uint64_t seed);

}  // namespace signweave
