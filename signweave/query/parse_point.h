#pragma once

#include "signweave/query/lexer.h"
#include "signweave/query/phase_query.h"

/// Inside this module only: a point of the signer in the text of a query.
namespace signweave {

/// Takes a point. `sided`: "hand" is none, since one of the two must be named. Throws QueryError.
Point parse_point(QueryLexer& in, bool sided = false);

/// That of a token which is taken already.
Point point_of(QueryLexer& in, const QueryToken& token, bool sided = false);

}  // namespace signweave
