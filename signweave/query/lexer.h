#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "signweave/core/error.h"

namespace signweave {

/// One token of a query.
struct QueryToken {
  enum class Kind {
    end,       ///< end of the query
    word,      ///< gloss, stroke, 300ms, LE-TEMPS-PREVU
    text,      ///< "…", `text` with its escapes resolved
    regex,     ///< /…/flags
    variable,  ///< $X
    symbol,    ///< ( ) [ & | ! @ , -> = != =~ < <= > >=
  };
  Kind kind = Kind::end;
  std::size_t begin = 0;  ///< byte offset
  std::string text;       ///< symbol: itself; regex: the pattern
  std::string flags;      ///< flags of a regex
};

/// The text in double quotes, escaped so that it parses to itself.
std::string in_quotes(std::string_view text);

/// Splits a query into tokens, with one token of look-ahead. Throws SyntaxError.
class QueryLexer {
 public:
  /// Borrows `text`, which must outlive the lexer.
  explicit QueryLexer(std::string_view text);

  const QueryToken& peek() const noexcept { return next_; }
  QueryToken take();
  bool next_is(std::string_view symbol) const noexcept;
  /// Takes the next token if it is this symbol.
  bool accept(std::string_view symbol);
  void expect(std::string_view symbol, std::string_view hint);
  /// The bytes up to the next ']', which is taken too. The next token must be "[".
  std::string_view bracketed();
  /// The bytes directly after the next token, which must be "@", up to white space, a parenthesis, an operator other
  /// than "/" and ",", or a quotation mark; takes the token and them. Empty if there are none.
  std::string_view after_at();
  /// If the next token is a word directly followed by a slash ("m/s"), joins both and the text after the slash into one
  /// word.
  void join_slash();
  /// The token as shown in an error: "'&'", "the end of the query".
  static std::string shown(const QueryToken& token);

  [[noreturn]] void fail(std::size_t offset, const std::string& what, ErrorCode code = ErrorCode::bad_input) const;
  /// "column 3", "line 2, column 3": counted in characters.
  std::string place_of(std::size_t offset) const;
  /// Offset at which a view into the text begins.
  std::size_t offset_of(std::string_view part) const noexcept {
    return static_cast<std::size_t>(part.data() - text_.data());
  }

 private:
  QueryToken read();
  QueryToken read_text();
  QueryToken read_regex();
  QueryToken read_word();
  void skip_blanks() noexcept;

  std::string_view text_;
  std::size_t at_ = 0;
  QueryToken next_;
};

}  // namespace signweave
