#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signweave/query/lexer.h"
#include "signweave/query/movement_term.h"

/// Internal to this module: parses the subject of a condition on movement if it is not a point.
namespace signweave {

/// Parses the rest of track(NAME) or gaze(ANGLE) after `name`, with its component. The quantity of `term` must be set.
/// Throws SyntaxError.
void parse_series(QueryLexer& in, const QueryToken& name, MovementTerm& term);

/// Takes ".height" as one token if it is next.
std::optional<QueryToken> take_component(QueryLexer& in);
[[noreturn]] void refuse_component(const QueryLexer& in, const QueryToken& token,
                                   const std::vector<std::string>& known);

}  // namespace signweave
