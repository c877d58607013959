#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "signweave/query/lexer.h"
#include "signweave/query/movement_term.h"
#include "signweave/query/phase_query.h"

/// Internal to this module: the value a movement is compared with, a number with its unit or a name such as "chin".
namespace signweave {

/// The values allowed after a comparison, as words.
struct AllowedValue {
  std::vector<Unit> units;
  std::string_view number;         ///< an example of a number; empty: no number is allowed
  std::vector<std::string> names;  ///< of zones, directions and contacts
  std::string_view compares;
};

AllowedValue allowed_for(const MovementTerm& term);

struct ParsedValue {
  decltype(Condition::value) value;
  std::string written;  ///< the word or number, without its unit
};

/// Takes the value after a comparison. Throws SyntaxError that lists the allowed values if it is not one of them.
ParsedValue parse_value(QueryLexer& in, const MovementTerm& term, const AllowedValue& allowed, Compare compare);

/// Takes the rest of enters(right_hand, shoulder) from the comma onwards.
void parse_zone(QueryLexer& in, Condition& condition);

}  // namespace signweave
