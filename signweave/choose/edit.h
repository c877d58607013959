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
  GlossRef from;  ///< its token is counted within the recording; without one the gloss must occur once
  GlossRef to;    ///< its token is counted over the database, as in an utterance; without one it is selected
};

/// A run of signs of the recording, both ends included; tokens counted within the recording.
struct SignRun {
  GlossRef first;
  GlossRef last;
};

/// An edit of a recording: replacements, or two runs that change places (the paper's two scenarios, section 5.1). What
/// lies before the first sign and after the last stays where that sign is kept or replaced; a swap that moves the sign
/// leaves it out.
struct Edit {
  std::vector<Replacement> replacements;
  std::optional<std::pair<SignRun, SignRun>> swap;
};

/// `A#1=B#2`, with quotes where a gloss holds '=' or ends like a token. Throws Error{bad_input}.
Replacement parse_replacement(std::string_view text);
/// `FROM..TO,FROM..TO`; a run of one sign may leave out `..TO`.
std::pair<SignRun, SignRun> parse_swap(std::string_view text);

/// What fills each place of the edited recording: runs as captured, with the recording's begin and end, and candidates
/// for what was replaced. Throws Error{not_found} with near matches, Error{bad_input} for a gloss that occurs more than
/// once and has no token, for runs that overlap or are reversed, for a run without any stroke.
std::vector<Choice> choices_for(const Contents& contents, std::string_view recording, const Edit& edit);

}  // namespace signweave
