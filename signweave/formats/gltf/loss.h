#pragma once

#include <vector>

#include "signweave/formats/gltf/rate.h"
#include "signweave/formats/gltf/space.h"

namespace signweave::gltf {

/// Tells how far the motion, interpolated between its frames, is at most from the file's own curves at their keys:
/// for keys that do not stand at frames. `rate_told`: the rate was asked for.
void tell_of_loss(const Content& content, const Take& take, const std::vector<JointPlace>& places, const Timing& timing,
                  bool rate_told, std::vector<Notice>& notices);

}  // namespace signweave::gltf
