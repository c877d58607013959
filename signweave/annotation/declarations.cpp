#include "signweave/annotation/declarations.h"

#include <algorithm>

namespace signweave {

Declarations declarations_of(const AnnotationDocument& document) {
  Declarations declarations;
  for (const auto& property : document.properties) {
    if (property.first.starts_with("signweave:")) declarations.push_back(property);
  }
  return declarations;
}

void merge_declarations(const Declarations& more, Declarations& to) {
  for (const auto& one : more) {
    if (std::ranges::find(to, one) == to.end()) to.push_back(one);
  }
}

}  // namespace signweave
