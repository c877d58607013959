#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "signweave/query/lexer.h"
#include "signweave/query/movement_term.h"
#include "signweave/query/phase_query.h"

/// Inside this module only: what a movement is compared with, a number with its unit or a name such as "chin".
namespace signweave {

/// What a value is in words: what may stand after the comparison.
struct AllowedValue {
  std::vector<Unit> units;
  std::string_view number;         ///< an example of one; empty: none
  std::vector<std::string> names;  ///< of places and the like
  std::string_view compares;
};

AllowedValue allowed_for(const MovementTerm& term);

struct ParsedValue {
  decltype(Condition::value) value;
  std::string written;  ///< the word or number, without its unit
};

/// Takes the value after a comparison. Throws QueryError, with what might have been written, where it is not allowed.
ParsedValue parse_value(QueryLexer& in, const MovementTerm& term, const AllowedValue& allowed, Compare compare);

/// Takes the rest of enters(right_hand, shoulder), from the comma on.
void parse_zone(QueryLexer& in, Condition& condition);

}  // namespace signweave
