#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// The tokens of XPath 1.0 (the recommendation's section 3.7). For expression.cpp only.
namespace signweave::xpath {

struct Token {
  enum class Kind {
    name,     ///< of an element, attribute, axis or function, with its prefix; or an operator that is a word
    literal,  ///< `text` is without its quotes
    number,
    symbol,  ///< "//", "[", "::", …
  };
  Kind kind = Kind::symbol;
  std::string_view text;     ///< part of the expression
  std::size_t offset = 0;    ///< where it begins in the expression
  bool is_operator = false;  ///< of a name: "and", "or", "mod", "div" where an operator stands

  bool is(std::string_view symbol) const noexcept { return kind == Kind::symbol && text == symbol; }
};

/// Cuts an expression into its tokens. Throws QueryError for a quote without its end, and a letter that begins none.
std::vector<Token> tokens_of(std::string_view text);

/// Throws QueryError, with a caret under the place.
[[noreturn]] void fail(std::string_view expression, std::size_t offset, const std::string& what);

}  // namespace signweave::xpath
