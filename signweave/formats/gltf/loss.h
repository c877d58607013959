#pragma once

#include <vector>

#include "signweave/formats/gltf/rate.h"
#include "signweave/formats/gltf/space.h"

namespace signweave::gltf {

/// Reports, for keys that are not at frames, the largest distance at those keys between the motion, interpolated
/// between its frames, and the file's own curves. `rate_given`: the caller gave the rate.
void report_loss(const Content& content, const Take& take, const std::vector<JointPlace>& places, const Timing& timing,
                 bool rate_given, std::vector<Notice>& notices);

}  // namespace signweave::gltf
