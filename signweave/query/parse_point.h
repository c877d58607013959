#pragma once

#include "signweave/query/lexer.h"
#include "signweave/query/phase_query.h"

/// Internal to this module: a point of the signer in the text of a query.
namespace signweave {

/// Takes a point. If `sided`, "hand" is not accepted: one of the two hands must be named. Throws SyntaxError.
Point parse_point(QueryLexer& in, bool sided = false);

/// The point of a token that is already taken.
Point point_of(QueryLexer& in, const QueryToken& token, bool sided = false);

}  // namespace signweave
