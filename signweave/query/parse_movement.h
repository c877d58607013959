#pragma once

#include "signweave/query/lexer.h"
#include "signweave/query/phase_query.h"

namespace signweave {

/// Whether a word begins a condition on movement, given that "(" follows.
bool is_quantity(std::string_view word) noexcept;
/// The words that begin a condition on movement, and "like".
std::vector<std::string> movement_words();

/// Parses the rest of a condition on movement after `name`; the next token is "(". Throws SyntaxError.
Condition parse_movement(QueryLexer& in, const QueryToken& name);

}  // namespace signweave
