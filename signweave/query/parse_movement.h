#pragma once

#include "signweave/query/lexer.h"
#include "signweave/query/phase_query.h"

namespace signweave {

/// True where a word begins a condition on movement, given that "(" follows.
bool is_quantity(std::string_view word) noexcept;
/// The words that begin one, and "like".
std::vector<std::string> movement_words();

/// The rest of a condition on movement, of which `name` is taken and "(" is next. Throws QueryError.
Condition parse_movement(QueryLexer& in, const QueryToken& name);

}  // namespace signweave
