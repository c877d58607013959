#pragma once

#include <vector>

#include "signweave/formats/eaf/elements.h"
#include "signweave/formats/eaf/parse.h"

namespace signweave::eaf {

/// What the tiers and annotations of a changed document were in the file. Borrows from the file's parts.
struct Known {
  std::vector<std::size_t> tiers;                               ///< [tier], index of the old tier; kNone: new
  std::vector<std::vector<const FileAnnotation*>> annotations;  ///< [tier][annotation]; null: new
  std::vector<std::vector<bool>> with_slots;  ///< [tier][annotation], true for an ALIGNABLE_ANNOTATION
};

/// Knows annotations by their ids and tiers by their names; a tier with a new name by its first annotation. An
/// annotation keeps its kind, even one that its tier's type does not allow, unless the stereotype of the type changed.
Known recognise(const FileParts& old, const CheckedDocument& checked);

}  // namespace signweave::eaf
