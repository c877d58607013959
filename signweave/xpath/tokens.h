#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// The tokens of XPath 1.0 (the recommendation's section 3.7). For expression.cpp only. libxml2 alone
/// would leave some errors unreported and always read whole documents: decision 233.
namespace signweave::xpath {

struct Token {
  enum class Kind {
    name,     ///< of an element, attribute, axis or function, with its prefix; or an operator spelled as a word
    literal,  ///< `text` is without its quotes
    number,
    symbol,  ///< "//", "[", "::", …
  };
  Kind kind = Kind::symbol;
  std::string_view text;     ///< view into the expression
  std::size_t offset = 0;    ///< byte offset in the expression
  bool is_operator = false;  ///< for a name: "and", "or", "mod", "div" in operator position

  bool is(std::string_view symbol) const noexcept { return kind == Kind::symbol && text == symbol; }
};

/// Splits an expression into tokens. Throws SyntaxError for an unclosed quote and for a character that begins no token.
std::vector<Token> tokens_of(std::string_view text);

/// Throws SyntaxError with a caret under the error.
[[noreturn]] void fail(std::string_view expression, std::size_t offset, const std::string& what);

}  // namespace signweave::xpath
