#pragma once

#include <cstddef>
#include <vector>

#include "signweave/formats/gltf/content.h"
#include "signweave/formats/gltf/take.h"

namespace signweave::gltf {

inline constexpr std::size_t kNoNode = static_cast<std::size_t>(-1);

/// The nodes of a file as trees.
struct NodeForest {
  std::vector<std::size_t> parent;  ///< [node]; kNoNode for a root
  std::vector<std::size_t> order;   ///< every node, parents first, children in the file's order
};

/// Throws Error{bad_input} if a node has two parents or is below itself.
NodeForest forest_of(const Content& content);

/// The nodes that become joints: one tree without gaps, parents first. If there are skins, their joints in the tree
/// that has the most joints moved by the take, the nodes between them, and moved nodes above them; otherwise the nodes
/// that the take moves and all below them. Cameras and lights are excluded. What had to be left out is in `notices`.
/// Throws Error{bad_input} if nothing is left.
std::vector<std::size_t> joints_of(const Content& content, const NodeForest& forest, const Take& take,
                                   std::vector<Notice>& notices);

}  // namespace signweave::gltf
