#pragma once

#include "signweave/query/lexer.h"
#include "signweave/query/phase_query.h"

namespace signweave {

/// Parses the rest of like("meteo"@1200..3400, right_hand) after `name`, the word "like". Throws SyntaxError.
Condition parse_example(QueryLexer& in, const QueryToken& name);

}  // namespace signweave
