#pragma once

#include <string>

#include "signweave/formats/eaf/elements.h"
#include "signweave/formats/eaf/parse.h"

namespace signweave::eaf {

/// The text of `xml`, taken apart as `old`, with new elements where `checked` differs from it and every other byte as
/// it was. Annotations and tiers are known again by their ids (a tier of another name by the annotations it holds); a
/// changed element keeps the attributes and children that we do not model. Text that was not UTF-8 comes out as UTF-8.
std::string edit(const Xml& xml, const FileParts& old, const CheckedDocument& checked);

}  // namespace signweave::eaf
