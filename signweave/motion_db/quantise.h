#pragma once

#include <functional>

#include "signweave/motion/motion.h"

namespace signweave::motion_db {

/// The motion with its numbers moved onto grids, so that it packs small: the only step of compact storing that loses
/// anything. In every frame every joint and every tip stays within `tolerance` (metres, above 0) of where it was in
/// model space; that is verified by forward kinematics, and where a stretch would break it, it is made finer, at last
/// kept as it was. Joints that hold still do so afterwards; the others make up for what their parents lost. Rotations
/// of joints that carry nothing are kept as if they carried something 5 cm away. Quaternions keep their hemisphere
/// (keep_hemisphere), and scalar tracks are untouched. Throws Error{bad_input} unless the tolerance is a number above
/// 0.
Motion quantise(const Motion& motion, float tolerance, const std::function<void(double fraction)>& progress = {});

/// The largest distance, in metres of model space, of a joint or tip of one motion from where it is in the other, over
/// all frames. Both have the same skeleton and count of frames.
double largest_distance(const Motion& a, const Motion& b);

}  // namespace signweave::motion_db
