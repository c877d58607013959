#pragma once

#include <cstddef>
#include <vector>

#include "signweave/formats/gltf/content.h"
#include "signweave/formats/gltf/take.h"

namespace signweave::gltf {

inline constexpr std::size_t kNoNode = static_cast<std::size_t>(-1);

/// The nodes of a file as trees.
struct NodeForest {
  std::vector<std::size_t> parent;  ///< [node], kNoNode of a top one
  std::vector<std::size_t> order;   ///< every node, parents first, children in the file's order
};

/// Throws Error{bad_input} where a node has two parents or is below itself.
NodeForest forest_of(const Content& content);

/// The nodes that become joints: one tree without gaps, parents first. With skins their joints in the one tree that
/// has most of those that the take moves, what lies between them, and whatever is moved above them; else the nodes that
/// the take moves with all below them. Cameras and lights are none. What had to be left out is in `notices`. Throws
/// Error{bad_input} where nothing is left.
std::vector<std::size_t> joints_of(const Content& content, const NodeForest& forest, const Take& take,
                                   std::vector<Notice>& notices);

}  // namespace signweave::gltf
