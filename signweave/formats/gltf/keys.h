#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "signweave/motion/motion.h"

namespace signweave::gltf {

/// Throws Error{bad_input}, with frame and joint or track, where a number of the motion is not finite or a rotation has
/// no length: glTF has no other numbers.
void require_finite(const Motion& motion);

/// The keys of one joint's rotation, [frame] x, y, z, w, unit, each in the hemisphere of the one before. True where
/// they differ. `keys` is written over.
bool rotation_keys(const Motion& motion, std::size_t joint, std::vector<Eigen::Vector4f>& keys);

/// The keys of one translated joint, [frame] metres. True where they differ.
bool translation_keys(const Motion& motion, std::size_t translated, std::vector<Eigen::Vector3f>& keys);

/// As JSON takes it: what is not UTF-8 loses its bytes beyond ASCII.
std::string utf8(std::string text);

}  // namespace signweave::gltf
