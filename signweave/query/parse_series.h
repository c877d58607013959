#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signweave/query/lexer.h"
#include "signweave/query/movement_term.h"

/// Inside this module only: reading what a condition on movement is about where that is no point.
namespace signweave {

/// The rest of track(NAME) or gaze(ANGLE), of which `name` is taken, with its component. The quantity of `term` must be
/// known. Throws QueryError.
void parse_series(QueryLexer& in, const QueryToken& name, MovementTerm& term);

/// Takes ".height" where that is next, as one token.
std::optional<QueryToken> take_component(QueryLexer& in);
[[noreturn]] void refuse_component(const QueryLexer& in, const QueryToken& token,
                                   const std::vector<std::string>& known);

}  // namespace signweave
