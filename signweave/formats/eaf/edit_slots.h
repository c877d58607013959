#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "signweave/formats/eaf/edit_known.h"
#include "signweave/formats/eaf/elements.h"
#include "signweave/formats/eaf/parse.h"

namespace signweave::eaf {

/// A slot as the changed file shall have it.
struct EditedSlot {
  std::string id;
  std::size_t old = kNone;  ///< index into the old slots; kNone: new
  std::optional<std::int64_t> time;
};

/// Which slots a changed document uses.
struct EditedSlots {
  struct Ends {
    std::size_t begin = kNone;  ///< indices into `slots`; kNone for an annotation without slots
    std::size_t end = kNone;
  };
  std::vector<EditedSlot> slots;
  std::vector<std::size_t> order;       ///< those that TIME_ORDER shall list, in its order
  std::vector<std::vector<Ends>> ends;  ///< [tier][annotation] of the changed document
};

/// Finds slots for a changed document.
///
/// A slot changes its time where all who use it and have times want the same new one; else those who want another time
/// get a new slot. A new annotation on a Time_Subdivision tier shares the slots of its neighbours and its parent where
/// the times are the same. Slots that nobody uses any more go; those that nobody used before stay. TIME_ORDER stays
/// sorted where it was: a slot with a new time moves to its place, and takes along the unaligned slots that lie after
/// it inside its annotation. Where it was not sorted, new slots go to its end.
EditedSlots edit_slots(const FileParts& old, const CheckedDocument& checked, const Known& known);

}  // namespace signweave::eaf
