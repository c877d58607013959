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

/// A text as libxml2 takes it.
inline const xmlChar* chars(const char* text) noexcept {
  return reinterpret_cast<const xmlChar*>(text);
}

inline constexpr const char* kSchemaInstance = "http://www.w3.org/2001/XMLSchema-instance";

/// Made node by node of what our own reader read, so that both see the same and libxml2's parser sees nothing: no
/// encodings, no entities, no DTD. Neighbouring texts are one node, as XPath wants it; CDATA is text. `alive` is called
/// now and then, and may throw.
Tree tree_of(const eaf::Xml& xml, const std::function<void()>& alive);

}  // namespace signweave::xpath
