#pragma once

#include <functional>
#include <vector>

#include "signweave/formats/gltf/rate.h"
#include "signweave/formats/gltf/space.h"
#include "signweave/motion/motion.h"

namespace signweave::gltf {

/// The motion of these joints, without tracks. Leaves that our own writer made of tips are tips again.
/// Throws Error{unsupported} where it would be too large, and what `progress` throws.
Motion motion_of(const Content& content, std::vector<JointPlace>& places, const Timing& timing, Budget& budget,
                 const std::function<void(double)>& progress);

/// How far the joints of the first pose reach along the axis where they reach farthest, metres.
float size_of_first_pose(const Motion& motion);

}  // namespace signweave::gltf
