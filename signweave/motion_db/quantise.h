#pragma once

#include <functional>

#include "signweave/motion/motion.h"

namespace signweave::motion_db {

/// Returns the motion with its numbers moved onto grids, so that it packs small: the only lossy step of compact
/// storage. In every frame every joint and tip stays within `tolerance` (metres, above 0) of its original position in
/// model space. This is verified by forward kinematics; a run that would violate it gets a finer grid, or in the end
/// its original values. Joints that hold still continue to do so; the others compensate for the errors of their
/// parents. Rotations of joints that carry nothing are treated as if they carried a point 5 cm away. Quaternions keep
/// their hemisphere (keep_hemisphere), and scalar tracks are unchanged. Throws Error{bad_input} unless the tolerance is
/// a number above 0.
Motion quantise(const Motion& motion, float tolerance, const std::function<void(double fraction)>& progress = {});

/// The largest distance, in metres of model space, between corresponding joints or tips of two motions over all frames.
/// Both must have the same skeleton and number of frames.
double largest_distance(const Motion& a, const Motion& b);

}  // namespace signweave::motion_db
