#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "signweave/formats/gltf/accessor.h"
#include "signweave/formats/gltf/content.h"
#include "signweave/formats/gltf/curve.h"

namespace signweave::gltf {

/// The curves that move one node.
struct NodeCurves {
  const Curve* translation = nullptr;
  const Curve* rotation = nullptr;
  const Curve* scale = nullptr;
  const Curve* weights = nullptr;

  bool place_or_turn_or_scale() const { return translation || rotation || scale; }
};

/// One animation of a file.
struct Take {
  std::size_t animation = 0;
  std::string name;  ///< or its number, from 1
  std::vector<std::unique_ptr<Curve>> curves;
  std::vector<NodeCurves> nodes;  ///< [node]
};

/// The requested animation, by name or by number from 1; the first if `wanted` is empty, and then a notice names the
/// others. Throws Error{not_found} if there is no such animation, Error{bad_input} if the file has none or its keys are
/// invalid.
Take take_of(const Content& content, Accessors& accessors, Budget& budget, const std::string& wanted,
             std::vector<Notice>& notices);

/// "node 3 'LeftHand'".
std::string node_text(const Content& content, std::size_t node);

}  // namespace signweave::gltf
