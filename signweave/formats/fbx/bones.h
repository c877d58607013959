#pragma once

#include <vector>

#include "signweave/core/error.h"
#include "signweave/formats/fbx/scene.h"

/// Selects the nodes of a scene that become joints.
namespace signweave::fbx {

/// Returns nodes, parents first, of which the first is the only root: the bones of the tree that has the most, and
/// every node above them. If no node has a bone's type, Null nodes count as bones. Notices say what was left out.
/// Throws Error{bad_input} if there are none.
std::vector<std::size_t> bones_of(const Source& source, const Scene& scene, std::vector<Notice>& notices);

}  // namespace signweave::fbx
