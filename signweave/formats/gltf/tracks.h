#pragma once

#include <vector>

#include "signweave/formats/gltf/accessor.h"
#include "signweave/formats/gltf/rate.h"
#include "signweave/formats/gltf/take.h"
#include "signweave/motion/motion.h"

namespace signweave::gltf {

/// Scalar tracks of a take: its morph weights, called like the targets or else MESH.weight.N, and the `tracks` in the
/// animation's extras, both at the motion's frames. Of two tracks of one name and the same values one is kept; else the
/// later one gets its mesh's name before its own.
std::vector<ScalarTrack> tracks_of(const Content& content, const Take& take, const Timing& timing, Budget& budget,
                                   std::vector<Notice>& notices);

}  // namespace signweave::gltf
