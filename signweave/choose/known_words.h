#pragma once

#include <string_view>

#include "signweave/database/database.h"
#include "signweave/notation/utterance.h"

namespace signweave {

/// True if a current recording has a sign with this gloss (in its match form). The time does not depend on the number
/// of signs.
bool has_gloss(const Segments& segments, std::string_view gloss);

/// The words of utterances that a database knows: its glosses when the first word is asked about. `database` must
/// outlive it.
UtteranceWords words_of(const Database& database);

}  // namespace signweave
