#pragma once

#include <string>
#include <utility>
#include <vector>

#include "signweave/annotation/document.h"

namespace signweave {

/// What files declare and everything made from them must repeat, such as that a demo's shapes are placeholders: pairs
/// of name ("signweave:…") and value. A name may have several values.
using Declarations = std::vector<std::pair<std::string, std::string>>;

/// The declarations of an annotation document: its properties whose names begin with "signweave:", in order.
Declarations declarations_of(const AnnotationDocument& document);

/// Appends those of `more` that `to` does not contain.
void merge_declarations(const Declarations& more, Declarations& to);

}  // namespace signweave
