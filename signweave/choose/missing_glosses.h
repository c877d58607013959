#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/notation/utterance.h"
#include "signweave/semantic_db/segments.h"

namespace signweave {

/// A gloss of an utterance that no sign has.
struct MissingGloss {
  std::size_t place = 0;             ///< of Utterance::places
  std::size_t places = 1;            ///< that are one gloss together, as LE MANS without its quotation marks
  std::string gloss;                 ///< as typed; of several places with blanks
  std::vector<std::string> matches;  ///< glosses that are the same but for loose_form; where none is, near ones
  bool folds = false;                ///< whether `matches` are the same
};

/// Glosses of an utterance are not there. `what()` is one line that names them all, and what would mend it.
struct MissingGlosses : Error {
  MissingGlosses(const std::string& text, std::vector<MissingGloss> missing_, std::string suggestion_)
      : Error(ErrorCode::not_found, text), missing(std::move(missing_)), suggestion(std::move(suggestion_)) {}

  std::vector<MissingGloss> missing;
  std::string suggestion;  ///< the utterance with the first match of each; empty where one has none
};

/// Throws MissingGlosses where a place names a gloss that no sign has. Where all are there, the time it takes grows
/// with the places only.
void require_glosses(const Utterance& utterance, const Segments& segments);

/// The utterance with the glosses that differ from its own in spelling only (loose_form), where each has one such
/// gloss. Adds what was taken for what to `notices`. Throws MissingGlosses for the others.
Utterance with_folded_glosses(const Utterance& utterance, const Segments& segments, std::vector<Notice>& notices);

}  // namespace signweave
