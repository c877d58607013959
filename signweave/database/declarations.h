#pragma once

#include <string>
#include <utility>
#include <vector>

#include "signweave/annotation/document.h"

namespace signweave {

/// What files say of themselves and must not be lost in what is made of them, such as that a demo's shapes are
/// placeholders: name ("signweave:…") and value.
using Declarations = std::vector<std::pair<std::string, std::string>>;

/// Those of an annotation document: its properties of such names.
Declarations declarations_of(const AnnotationDocument& document);

/// Adds those of `more` that are not there.
void add_new(const Declarations& more, Declarations& declarations);

}  // namespace signweave
