#pragma once

#include <string>

#include "signweave/formats/eaf/elements.h"
#include "signweave/formats/eaf/parse.h"

namespace signweave::eaf {

/// Returns the text of `xml`, parsed as `old`, with new elements where `checked` differs from it and every other byte
/// unchanged. Annotations and tiers are matched by their ids (a renamed tier by the annotations it holds); a changed
/// element keeps the attributes and children that we do not model. Text that was not UTF-8 becomes UTF-8.
std::string edit(const Xml& xml, const FileParts& old, const CheckedDocument& checked);

}  // namespace signweave::eaf
