#pragma once

#include <functional>
#include <vector>

#include "signweave/formats/gltf/rate.h"
#include "signweave/formats/gltf/space.h"
#include "signweave/motion/motion.h"

namespace signweave::gltf {

/// The motion of these joints, without tracks. Leaves that our own writer created for tips become tips again. Throws
/// Error{unsupported} if the motion would be too large, and whatever `progress` throws.
Motion motion_of(const Content& content, std::vector<JointPlace>& places, const Timing& timing, Budget& budget,
                 const std::function<void(double)>& progress);

/// The extent of the joints of the first pose along the axis on which it is greatest, in metres.
float size_of_first_pose(const Motion& motion);

}  // namespace signweave::gltf
