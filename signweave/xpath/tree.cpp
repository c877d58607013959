#include "signweave/xpath/tree.h"

#include <new>
#include <string>

namespace signweave::xpath {
namespace {

template <class Node>
Node* made(Node* node) {
  if (node == nullptr) throw std::bad_alloc();
  return node;
}

/// The namespace of a name's prefix if it is declared, and the name without the prefix; otherwise the whole name.
struct Resolved {
  xmlNs* name_space = nullptr;
  const char* name = nullptr;
};

Resolved resolve(xmlDoc* tree, xmlNode* node, const char* name, bool attribute) {
  const std::string_view whole(name);
  const std::size_t colon = whole.find(':');
  if (colon == whole.npos) return {attribute ? nullptr : xmlSearchNs(tree, node, nullptr), name};
  const std::string prefix(whole.substr(0, colon));
  xmlNs* found = xmlSearchNs(tree, node, chars(prefix.c_str()));
  return found == nullptr ? Resolved{nullptr, name} : Resolved{found, name + colon + 1};
}

xmlNode* element(xmlDoc* tree, xmlNode* parent, pugi::xml_node from) {
  xmlNode* node = made(xmlNewDocNode(tree, nullptr, chars(from.name()), nullptr));
  if (parent == nullptr) {
    xmlDocSetRootElement(tree, node);
  } else {
    xmlAddChild(parent, node);
  }
  bool prefixed = std::string_view(from.name()).find(':') != std::string_view::npos;
  for (const pugi::xml_attribute one : from.attributes()) {
    const std::string_view name = one.name();
    if (name == "xmlns") xmlNewNs(node, chars(one.value()), nullptr);
    if (name.starts_with("xmlns:")) xmlNewNs(node, chars(one.value()), chars(one.name() + 6));
  }
  if (prefixed || node->nsDef != nullptr || (parent != nullptr && parent->ns != nullptr)) {
    const Resolved resolved = resolve(tree, node, from.name(), false);
    if (prefixed && resolved.name_space != nullptr) xmlNodeSetName(node, chars(resolved.name));
    xmlSetNs(node, resolved.name_space);
  }
  for (const pugi::xml_attribute one : from.attributes()) {
    const std::string_view name = one.name();
    if (name == "xmlns" || name.starts_with("xmlns:")) continue;
    const Resolved resolved = resolve(tree, node, one.name(), true);
    made(xmlNewNsProp(node, resolved.name_space, chars(resolved.name), chars(one.value())));
  }
  return node;
}

}  // namespace

Tree tree_of(const eaf::Xml& xml, const std::function<void()>& alive) {
  Tree tree(made(xmlNewDoc(chars("1.0"))));
  xmlNode* parent = nullptr;
  // Iterative: a file may be nested as deep as it is long.
  pugi::xml_node from = xml.document().first_child();
  for (std::size_t nodes = 0; from; ++nodes) {
    if (nodes % 1024 == 0) alive();
    xmlNode* node = nullptr;
    switch (from.type()) {
      case pugi::node_element:
        // A second root, which XML does not allow, is omitted with its contents.
        if (parent != nullptr || xmlDocGetRootElement(tree.get()) == nullptr) {
          node = element(tree.get(), parent, from);
        }
        break;
      case pugi::node_pcdata:
      case pugi::node_cdata:
        if (parent != nullptr && *from.value() != '\0') {
          xmlAddChild(parent, made(xmlNewDocText(tree.get(), chars(from.value()))));
        }
        break;
      case pugi::node_comment:
        xmlAddChild(parent != nullptr ? parent : reinterpret_cast<xmlNode*>(tree.get()),
                    made(xmlNewDocComment(tree.get(), chars(from.value()))));
        break;
      case pugi::node_pi:
        xmlAddChild(parent != nullptr ? parent : reinterpret_cast<xmlNode*>(tree.get()),
                    made(xmlNewDocPI(tree.get(), chars(from.name()), chars(from.value()))));
        break;
      default:  // the XML declaration and a DOCTYPE are not nodes in XPath
        break;
    }
    if (node != nullptr && from.first_child()) {
      parent = node;
      from = from.first_child();
      continue;
    }
    while (from && !from.next_sibling()) {
      from = from.parent();
      if (from.type() != pugi::node_element) return tree;
      parent = parent->parent != nullptr && parent->parent->type == XML_ELEMENT_NODE ? parent->parent : nullptr;
    }
    from = from.next_sibling();
  }
  return tree;
}

}  // namespace signweave::xpath
