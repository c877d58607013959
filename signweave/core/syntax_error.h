#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "signweave/core/error.h"

namespace signweave {

/// An error in a text that the user wrote: a query, or an XPath expression. `what()` is one line,
/// "query:LINE:COLUMN: what is wrong, and how to fix it". Code bad_input, or unsupported for planned features that this
/// version lacks ("not supported yet").
struct SyntaxError : Error {
  SyntaxError(ErrorCode code, const std::string& text, std::size_t line_, std::size_t column_, std::string caret_)
      : Error(code, text), line(line_), column(column_), caret(std::move(caret_)) {}

  std::size_t line;    ///< from 1
  std::size_t column;  ///< from 1, in characters (code points)
  std::string caret;   ///< the faulty line of the text (shortened if long), a line feed, and '^' under the error
};

/// The position of a byte in a text of several lines.
struct TextPosition {
  std::size_t line = 1;        ///< from 1
  std::size_t column = 1;      ///< from 1, in characters (code points)
  std::string_view line_text;  ///< the whole line, without its line feed; a view into the text
  std::size_t offset = 0;      ///< in bytes, in `line_text`; its size at most
};

/// The position of the byte at `offset`; of the end for an offset past it.
TextPosition position_in(std::string_view text, std::size_t offset) noexcept;

/// The number of characters (code points) of a text in UTF-8.
std::size_t count_characters(std::string_view text) noexcept;

}  // namespace signweave
