#pragma once

#include <vector>

#include "signweave/formats/gltf/accessor.h"
#include "signweave/formats/gltf/joints.h"

namespace signweave::gltf {

/// Looks whether the bind pose of each skin is that of the nodes. A motion needs the nodes alone, so whatever is found
/// is told: matrices that are not finite or cannot be turned round, and the largest disagreement between neighbouring
/// joints. `unit` is metres per unit of the file. Throws Error{bad_input} where the numbers are not there.
void look_at_bind_poses(const Content& content, const NodeForest& forest, Accessors& accessors, double unit,
                        std::vector<Notice>& notices);

}  // namespace signweave::gltf
