#pragma once

#include <vector>

#include "signweave/formats/gltf/accessor.h"
#include "signweave/formats/gltf/rate.h"
#include "signweave/formats/gltf/take.h"
#include "signweave/motion/motion.h"

namespace signweave::gltf {

/// Scalar tracks of a take, at the motion's frames: its morph weights, named after the targets or else MESH.weight.N,
/// and the `tracks` in the animation's extras. Of two tracks with the same name and values one is kept; if the values
/// differ, the later one is prefixed with its mesh's name.
std::vector<ScalarTrack> tracks_of(const Content& content, const Take& take, const Timing& timing, Budget& budget,
                                   std::vector<Notice>& notices);

}  // namespace signweave::gltf
