#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "signweave/core/error.h"
#include "signweave/query/phase_query.h"

namespace signweave {

/// An error in the text of a query. `what()` is one line, "query:LINE:COLUMN: what is wrong, and how to fix it". Code
/// bad_input, or unsupported for planned features that this version lacks ("not supported yet").
struct QueryError : Error {
  QueryError(ErrorCode code, const std::string& text, std::size_t line_, std::size_t column_, std::string caret_)
      : Error(code, text), line(line_), column(column_), caret(std::move(caret_)) {}

  std::size_t line;    ///< from 1
  std::size_t column;  ///< from 1, in characters (code points)
  std::string caret;   ///< the faulty line of the query (shortened if long), a line feed, and '^' under the error
};

/// Parses a query; the grammar is in docs/query.md. Throws QueryError. Accepts at most 64 KiB of UTF-8, 200 levels of
/// nesting and 64 places of a sequence, so that no text can exhaust the stack or memory.
PhaseQuery parse(std::string_view text);

}  // namespace signweave
