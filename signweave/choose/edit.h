#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signweave/choose/candidate.h"
#include "signweave/choose/select.h"
#include "signweave/database/database.h"
#include "signweave/notation/utterance.h"

namespace signweave {

/// "Say this sign of the recording by that one."
struct Replacement {
  GlossRef from;  ///< its token number counts within the recording; without one the gloss must occur once
  GlossRef to;    ///< its token number counts over the database, as in an utterance; without one it is selected
};

/// A run of signs of the recording, inclusive; token numbers count within the recording.
struct SignRun {
  GlossRef first;
  GlossRef last;
};

/// "Let this hand say that sign instead of this one."
struct HandReplacement {
  Side hand = Side::left;
  Replacement replacement;  ///< token numbers of `from` count over the signs of that hand
};

/// An edit of a recording: replacements, or two runs that are swapped (the paper's two scenarios, section 5.1). The
/// motion before the first sign and after the last is kept if that sign is kept or replaced, and dropped if a swap
/// moves it.
struct Edit {
  std::vector<Replacement> replacements;
  std::optional<std::pair<SignRun, SignRun>> swap;
  std::vector<HandReplacement> hands;  ///< not together with the others
};

/// Parses `A#1=B#2`, with quotes if a gloss contains '=' or ends like a token. Throws Error{bad_input}.
Replacement parse_replacement(std::string_view text);
/// Parses `left:A#1=B#2` or `right:…`. Throws Error{bad_input}.
HandReplacement parse_hand_replacement(std::string_view text);
/// Parses `FROM..TO,FROM..TO`; a run of one sign may omit `..TO`.
std::pair<SignRun, SignRun> parse_swap(std::string_view text);

/// The choices for each place of the edited recording: runs as captured, with the recording's begin and end, and
/// candidates for replaced signs. Throws Error{not_found} with near matches; Error{bad_input} for an ambiguous gloss
/// without token, for runs that overlap or are reversed, and for a run without any stroke.
std::vector<Choice> choices_for(const Contents& contents, std::string_view recording, const Edit& edit);

}  // namespace signweave
