#include "signweave/database/declarations.h"

#include <algorithm>

namespace signweave {

Declarations declarations_of(const AnnotationDocument& document) {
  Declarations declarations;
  for (const auto& property : document.properties) {
    if (property.first.starts_with("signweave:")) declarations.push_back(property);
  }
  return declarations;
}

void add_new(const Declarations& more, Declarations& declarations) {
  for (const auto& one : more) {
    if (std::ranges::find(declarations, one) == declarations.end()) declarations.push_back(one);
  }
}

}  // namespace signweave
