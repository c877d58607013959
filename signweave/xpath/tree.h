#pragma once

#include <libxml/tree.h>

#include <functional>
#include <memory>

#include "signweave/formats/eaf/xml.h"

/// A document as libxml2's tree, for evaluate.cpp only.
namespace signweave::xpath {

struct FreeTree {
  void operator()(xmlDoc* tree) const noexcept { xmlFreeDoc(tree); }
};
using Tree = std::unique_ptr<xmlDoc, FreeTree>;

/// A text as libxml2's character type.
inline const xmlChar* chars(const char* text) noexcept {
  return reinterpret_cast<const xmlChar*>(text);
}

inline constexpr const char* kSchemaInstance = "http://www.w3.org/2001/XMLSchema-instance";

/// Builds the tree node by node from what our own reader read, so that both see the same document and libxml2's parser
/// is not involved: no encodings, no entities, no DTD. Adjacent texts become one node, as XPath requires; CDATA is
/// text. `alive` is called regularly and may throw.
Tree tree_of(const eaf::Xml& xml, const std::function<void()>& alive);

}  // namespace signweave::xpath
