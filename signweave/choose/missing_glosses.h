#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/notation/utterance.h"
#include "signweave/semantic_db/segments.h"

namespace signweave {

/// A sign of a place's parts.
struct PartSignNumber {
  std::size_t part = 0;  ///< of Place::parts
  std::size_t sign = 0;  ///< of PlacePart::signs
};

/// A gloss of an utterance that the database lacks.
struct MissingGloss {
  std::size_t place = 0;             ///< of Utterance::places
  std::size_t places = 1;            ///< number of places that form one gloss, such as LE MANS without quotation marks
  std::string gloss;                 ///< as typed; several places are separated by blanks
  std::vector<std::string> matches;  ///< glosses with the same loose_form; if there are none, similar ones
  bool folds = false;                ///< true if `matches` have the same loose_form
  std::optional<PartSignNumber> part = {};  ///< the sign of the place's parts; none: of the place itself
};

/// Thrown if glosses of an utterance are missing. `what()` is one line that names them all and suggests a fix.
struct MissingGlosses : Error {
  MissingGlosses(const std::string& text, std::vector<MissingGloss> missing_, std::string suggestion_)
      : Error(ErrorCode::not_found, text), missing(std::move(missing_)), suggestion(std::move(suggestion_)) {}

  std::vector<MissingGloss> missing;
  std::string suggestion;  ///< the utterance with the first match of each; empty if one has no match
};

/// Throws MissingGlosses if a place or a part names a gloss that the database lacks. If none is missing, the time
/// depends only on the number of signs.
void require_glosses(const Utterance& utterance, const Segments& segments);

/// The utterance with missing glosses replaced by glosses that differ only in spelling (loose_form), if there is
/// exactly one for each. Reports the replacements in `notices`. Throws MissingGlosses for the others.
Utterance with_folded_glosses(const Utterance& utterance, const Segments& segments, std::vector<Notice>& notices);

}  // namespace signweave
