#pragma once

#include "signweave/query/lexer.h"
#include "signweave/query/phase_query.h"

/// Internal to this module: the times of a query.
namespace signweave {

/// "300ms", "1.5s", or number and unit as two words; `token` is already taken. Throws SyntaxError.
Milliseconds parse_time(QueryLexer& in, const QueryToken& token);

/// "[100ms..500ms]", of which one bound may be omitted. The next token is "[". Throws SyntaxError.
Interval parse_gap(QueryLexer& in);

}  // namespace signweave
