#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "signweave/formats/eaf/edit_known.h"
#include "signweave/formats/eaf/elements.h"
#include "signweave/formats/eaf/parse.h"

namespace signweave::eaf {

/// A slot of the changed file.
struct EditedSlot {
  std::string id;
  std::size_t old = kNone;  ///< index into the old slots; kNone: new
  std::optional<std::int64_t> time;
};

/// The slots that a changed document uses.
struct EditedSlots {
  struct Ends {
    std::size_t begin = kNone;  ///< indices into `slots`; kNone for an annotation without slots
    std::size_t end = kNone;
  };
  std::vector<EditedSlot> slots;
  std::vector<std::size_t> order;       ///< those to list in TIME_ORDER, in this order
  std::vector<std::vector<Ends>> ends;  ///< [tier][annotation] of the changed document
};

/// Assigns slots for a changed document.
///
/// A slot changes its time if all annotations that use it and have times require the same new one; otherwise those that
/// require another time get a new slot. A new annotation on a Time_Subdivision tier shares the slots of its neighbours
/// and its parent if the times are the same. Slots that are no longer used are removed; those that were never used
/// stay. If TIME_ORDER was sorted, it stays sorted: a slot with a new time moves to its position, together with the
/// unaligned slots after it inside its annotation. If it was not sorted, new slots are appended.
EditedSlots edit_slots(const FileParts& old, const CheckedDocument& checked, const Known& known);

}  // namespace signweave::eaf
