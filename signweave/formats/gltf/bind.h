#pragma once

#include <vector>

#include "signweave/formats/gltf/accessor.h"
#include "signweave/formats/gltf/joints.h"

namespace signweave::gltf {

/// Checks whether the bind pose of each skin agrees with the nodes. A motion needs only the nodes, so problems are
/// reported as notices: matrices that are not finite or cannot be inverted, and the largest disagreement between
/// neighbouring joints. `unit` is metres per unit of the file. Throws Error{bad_input} if the numbers are missing.
void check_bind_poses(const Content& content, const NodeForest& forest, Accessors& accessors, double unit,
                      std::vector<Notice>& notices);

}  // namespace signweave::gltf
