#pragma once

#include "signweave/query/lexer.h"
#include "signweave/query/phase_query.h"

/// Internal to this module: conditions on where a hand moves or points: right_hand points at @left.
namespace signweave {

/// Whether the word `name`, which is already taken, begins such a condition: it is a point before "moves" or "points",
/// or one of these two words itself.
bool begins_aim(const QueryLexer& in, const QueryToken& name);

/// Takes the rest of the condition. Throws SyntaxError.
Condition parse_aim(QueryLexer& in, const QueryToken& name);

}  // namespace signweave
