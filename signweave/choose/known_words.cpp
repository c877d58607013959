#include "signweave/choose/known_words.h"

#include <algorithm>
#include <memory>
#include <string>

#include "signweave/core/text.h"

namespace signweave {

bool has_gloss(const Segments& segments, std::string_view gloss) {
  const std::string form = match_form(gloss);
  return std::ranges::any_of(segments.members(), [&](const Segments::Member& member) {
    const std::uint32_t label = member.table.find_text(form);
    if (label == SegmentTable::kNone) return false;
    return std::ranges::any_of(member.table.with_label(RowKind::sign, label), [&](RowId row) {
      return member.numbers[member.table.recording(row)] != Segments::kNone;
    });
  });
}

UtteranceWords words_of(const Database& database) {
  return {.is_gloss =
              [&database, segments = std::shared_ptr<const Segments>()](std::string_view word) mutable {
                if (!segments) segments = database.segments();
                return has_gloss(*segments, word);
              },
          .is_expression = {}};
}

}  // namespace signweave
