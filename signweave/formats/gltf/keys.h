#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "signweave/motion/motion.h"

namespace signweave::gltf {

/// Throws Error{bad_input}, with frame and joint or track, if a number of the motion is not finite or a rotation has
/// zero norm, because glTF allows neither.
void require_finite(const Motion& motion);

/// The keys of one joint's rotation, [frame] x, y, z, w, unit, each in the hemisphere of the previous one. True if they
/// differ. `keys` is overwritten.
bool rotation_keys(const Motion& motion, std::size_t joint, std::vector<Eigen::Vector4f>& keys);

/// The keys of one translated joint, [frame] metres. True if they differ.
bool translation_keys(const Motion& motion, std::size_t translated, std::vector<Eigen::Vector3f>& keys);

/// Text as JSON accepts it: if it is not UTF-8, its non-ASCII bytes are removed.
std::string utf8(std::string text);

}  // namespace signweave::gltf
