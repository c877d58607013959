#pragma once

#include "signweave/query/lexer.h"
#include "signweave/query/phase_query.h"

namespace signweave {

/// The rest of like("meteo"@1200..3400, right_hand), of which `name`, the word "like", is taken. Throws QueryError.
Condition parse_example(QueryLexer& in, const QueryToken& name);

}  // namespace signweave
