#include "signweave/xpath/tokens.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/syntax_error.h"
#include "signweave/core/text.h"

namespace signweave::xpath {
namespace {

bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}
bool begins_name(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || static_cast<unsigned char>(c) >= 0x80;
}
bool goes_on(char c) noexcept {
  return begins_name(c) || is_digit(c) || c == '-' || c == '.';
}

/// Whether the next word is an operator rather than a name: it follows a complete operand.
bool ends_operand(const Token& token) {
  if (token.kind != Token::Kind::symbol) return !token.is_operator;
  return token.is(")") || token.is("]") || token.is(".") || token.is("..") || token.is("*");
}

}  // namespace

void fail(std::string_view expression, std::size_t offset, const std::string& what) {
  const TextPosition at = position_in(expression, offset);
  std::string_view shown = at.line_text;
  constexpr std::size_t kMost = 200;  // a long line is cut
  std::string caret;
  if (shown.size() <= kMost) {
    caret = std::string(shown) + '\n' + std::string(at.column - 1, ' ') + '^';
  } else {
    std::size_t from = at.offset > kMost / 2 ? at.offset - kMost / 2 : 0;
    while (from > 0 && (static_cast<unsigned char>(shown[from]) & 0xC0) == 0x80) --from;
    const std::size_t width = count_characters(shown.substr(from, at.offset - from));
    shown = shown.substr(from, kMost);
    while (!shown.empty() && !is_utf8(shown)) shown.remove_suffix(1);
    caret = std::string(shown) + '\n' + std::string(width, ' ') + '^';
  }
  throw SyntaxError(ErrorCode::bad_input, fmt::format("xpath:{}:{}: {}", at.line, at.column, what), at.line, at.column,
                    std::move(caret));
}

std::vector<Token> tokens_of(std::string_view text) {
  constexpr std::string_view kTwo[] = {"//", "..", "::", "!=", "<=", ">="};
  constexpr std::string_view kOne = "()[].@,/|+-=<>*$";
  std::vector<Token> tokens;
  std::size_t at = 0;
  const auto add = [&](Token::Kind kind, std::size_t begin, std::size_t end) {
    tokens.push_back({.kind = kind, .text = text.substr(begin, end - begin), .offset = begin});
  };
  for (;;) {
    at = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
    if (at == text.size()) return tokens;
    const char c = text[at];
    if (c == '"' || c == '\'') {
      const std::size_t end = text.find(c, at + 1);
      if (end == text.npos) fail(text, at, fmt::format("the text has no closing quote; end it with {}", c));
      tokens.push_back({.kind = Token::Kind::literal, .text = text.substr(at + 1, end - at - 1), .offset = at});
      at = end + 1;
    } else if (is_digit(c) || (c == '.' && at + 1 < text.size() && is_digit(text[at + 1]))) {
      std::size_t end = at;
      while (end < text.size() && (is_digit(text[end]) || text[end] == '.')) ++end;
      add(Token::Kind::number, at, end);
      at = end;
    } else if (begins_name(c)) {
      std::size_t end = at;
      while (end < text.size() && goes_on(text[end])) ++end;
      // A prefix and its name, or a prefix with '*', are one token.
      if (end + 1 < text.size() && text[end] == ':' && (begins_name(text[end + 1]) || text[end + 1] == '*')) {
        const bool all = text[++end] == '*';
        if (all) ++end;
        while (!all && end < text.size() && goes_on(text[end])) ++end;
      }
      const bool operand = !tokens.empty() && ends_operand(tokens.back());
      add(Token::Kind::name, at, end);
      tokens.back().is_operator = operand;
      at = end;
    } else {
      std::size_t size = 0;
      for (const std::string_view two : kTwo) {
        if (text.substr(at, 2) == two) size = 2;
      }
      if (size == 0 && kOne.find(c) != kOne.npos) size = 1;
      if (size == 0) {
        fail(text, at, fmt::format("'{}' does not begin any XPath token; remove it", printable(text.substr(at, 1))));
      }
      add(Token::Kind::symbol, at, at + size);
      at += size;
    }
  }
}

}  // namespace signweave::xpath
