#pragma once

#include <vector>

#include "signweave/formats/eaf/elements.h"
#include "signweave/formats/eaf/parse.h"

namespace signweave::eaf {

/// The tiers and annotations of the file that those of a changed document correspond to. Borrows from the file's parts.
struct Known {
  std::vector<std::size_t> tiers;                               ///< [tier], index of the old tier; kNone: new
  std::vector<std::vector<const FileAnnotation*>> annotations;  ///< [tier][annotation]; null: new
  std::vector<std::vector<bool>> with_slots;  ///< [tier][annotation], true for an ALIGNABLE_ANNOTATION
};

/// Matches annotations by their ids and tiers by their names; a renamed tier by its first annotation. An annotation
/// keeps its kind, even one that its tier's type does not allow, unless the stereotype of the type changed.
Known recognise(const FileParts& old, const CheckedDocument& checked);

}  // namespace signweave::eaf
