#pragma once

#include <vector>

#include "signweave/core/error.h"
#include "signweave/formats/fbx/scene.h"

/// Which nodes of a scene become joints.
namespace signweave::fbx {

/// Nodes, parents first, the first the only root: the bones of the tree that has the most, and every node above them.
/// Where nothing is called a bone, Null nodes are taken for bones. Notices say what was left out. Throws
/// Error{bad_input} where there are none.
std::vector<std::size_t> bones_of(const Source& source, const Scene& scene, std::vector<Notice>& notices);

}  // namespace signweave::fbx
