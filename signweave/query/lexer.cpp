#include "signweave/query/lexer.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/syntax_error.h"
#include "signweave/core/text.h"

namespace signweave {
namespace {

constexpr std::size_t kLongest = 64 * 1024;
constexpr std::string_view kBlanks = " \t\r\n\v\f";

bool continues(char c) noexcept {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

/// Length in bytes of the first character of `text`, as given by its first byte.
std::size_t announced(std::string_view text) noexcept {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t size = lead < 0xC0 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  return std::min(size, text.size());
}

/// The line around `offset` with a caret below; a long line is cut to about 60 characters on either side.
std::string caret_under(std::string_view line, std::size_t offset) {
  constexpr std::size_t kAround = 60;
  std::size_t begin = offset;
  for (std::size_t n = 0; begin > 0 && n < kAround; --begin) n += continues(line[begin - 1]) ? 0 : 1;
  while (begin > 0 && continues(line[begin])) --begin;
  std::size_t end = offset;
  for (std::size_t n = 0; end < line.size() && n <= kAround; ++end) n += continues(line[end]) ? 0 : 1;
  while (end < line.size() && continues(line[end])) ++end;
  std::string shown(line.substr(begin, end - begin));
  // One column per character, whatever its width.
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  return shown + '\n' + std::string(count_characters(line.substr(begin, offset - begin)), ' ') + '^';
}

bool ends_word(std::string_view rest) noexcept {
  constexpr std::string_view kSymbols = "\"()[]&|!=<>~/@,;";
  const char c = rest.front();
  return static_cast<unsigned char>(c) < 0x21 || c == 0x7F || kSymbols.find(c) != std::string_view::npos ||
         rest.starts_with("->");
}

/// Quotation marks that word processors substitute for straight ones, or that other languages use.
bool starts_with_odd_quote(std::string_view rest) noexcept {
  constexpr std::string_view kQuotes[] = {"'", "`", "“", "”", "„", "«", "»", "‘", "’"};
  return std::any_of(std::begin(kQuotes), std::end(kQuotes), [&](auto quote) { return rest.starts_with(quote); });
}

}  // namespace

std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '\n') {
      result += "\\n";
    } else if (c == '\t') {
      result += "\\t";
    } else {
      if (c == '"' || c == '\\') result += '\\';
      result += c;
    }
  }
  return result + '"';
}

QueryLexer::QueryLexer(std::string_view text) : text_(text) {
  if (text_.size() > kLongest) {
    text_ = {};
    fail(0, fmt::format("the query has {} bytes; at most {} are allowed: split it", text.size(), kLongest));
  }
  for (std::size_t at = 0; at < text_.size();) {
    const std::string_view letter = text_.substr(at, announced(text_.substr(at)));
    if (!is_utf8(letter)) fail(at, "the query is not UTF-8; save or type it as UTF-8");
    at += letter.size();
  }
  next_ = read();
}

QueryToken QueryLexer::take() {
  QueryToken result = std::move(next_);
  next_ = read();
  return result;
}

bool QueryLexer::next_is(std::string_view symbol) const noexcept {
  return next_.kind == QueryToken::Kind::symbol && next_.text == symbol;
}

bool QueryLexer::accept(std::string_view symbol) {
  if (!next_is(symbol)) return false;
  next_ = read();
  return true;
}

void QueryLexer::expect(std::string_view symbol, std::string_view hint) {
  if (!accept(symbol)) fail(next_.begin, fmt::format("expected '{}', found {}; {}", symbol, shown(next_), hint));
}

std::string_view QueryLexer::bracketed() {
  const std::size_t begin = next_.begin + 1;
  const std::size_t end = text_.find(']', begin);
  if (end == std::string_view::npos) fail(next_.begin, "'[' without ']'; write a gap as ->[100ms..500ms]");
  at_ = end + 1;
  next_ = read();
  return text_.substr(begin, end - begin);
}

std::string_view QueryLexer::after_at() {
  const std::size_t begin = at_;
  const auto goes_on = [&] {
    return at_ < text_.size() && (text_[at_] == '/' || text_[at_] == ',' || !ends_word(text_.substr(at_)));
  };
  while (goes_on()) ++at_;
  const std::string_view result = text_.substr(begin, at_ - begin);
  next_ = read();
  return result;
}

void QueryLexer::join_slash() {
  if (next_.kind != QueryToken::Kind::word || at_ >= text_.size() || text_[at_] != '/') return;
  next_.text += text_[at_++];
  for (; at_ < text_.size() && !ends_word(text_.substr(at_)); ++at_) next_.text += text_[at_];
}

std::string QueryLexer::shown(const QueryToken& token) {
  switch (token.kind) {
    case QueryToken::Kind::end:
      return "the end of the query";
    case QueryToken::Kind::text:
      return '"' + printable(token.text) + '"';
    case QueryToken::Kind::regex:
      return '/' + printable(token.text) + '/';
    case QueryToken::Kind::word:
    case QueryToken::Kind::variable:
    case QueryToken::Kind::symbol:
      break;
  }
  return '\'' + printable(token.text) + '\'';
}

void QueryLexer::fail(std::size_t offset, const std::string& what, ErrorCode code) const {
  const TextPosition at = position_in(text_, offset);
  throw SyntaxError(code, fmt::format("query:{}:{}: {}", at.line, at.column, what), at.line, at.column,
                    caret_under(at.line_text, at.offset));
}

std::string QueryLexer::place_of(std::size_t offset) const {
  const TextPosition at = position_in(text_, offset);
  return at.line == 1 ? fmt::format("column {}", at.column) : fmt::format("line {}, column {}", at.line, at.column);
}

void QueryLexer::skip_blanks() noexcept {
  at_ = std::min(text_.find_first_not_of(kBlanks, at_), text_.size());
}

QueryToken QueryLexer::read() {
  skip_blanks();
  const std::string_view rest = text_.substr(at_);
  if (rest.empty()) return {QueryToken::Kind::end, at_, "", ""};
  constexpr std::string_view kSymbols[] = {"->", "!=", "=~", "<=", ">=", "(", ")", "[",
                                           "&",  "|",  "!",  "@",  ",",  "=", "<", ">"};
  for (const std::string_view symbol : kSymbols) {
    if (!rest.starts_with(symbol)) continue;
    const std::size_t begin = at_;
    at_ += symbol.size();
    return {QueryToken::Kind::symbol, begin, std::string(symbol), ""};
  }
  if (rest.front() == '"') return read_text();
  if (rest.front() == '/') return read_regex();
  return read_word();
}

QueryToken QueryLexer::read_text() {
  QueryToken result{QueryToken::Kind::text, at_, "", ""};
  for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
    if (text_[at_] != '\\') {
      result.text += text_[at_];
      continue;
    }
    constexpr std::string_view kEscapes = "\"\\nt";
    constexpr std::string_view kMeanings = "\"\\\n\t";
    const std::size_t which = ++at_ < text_.size() ? kEscapes.find(text_[at_]) : 0;
    if (which == std::string_view::npos) {
      fail(at_ - 1, R"(a backslash in a text is followed by \, ", n or t; write \\ for a backslash)");
    }
    result.text += kMeanings[which];
  }
  if (at_ >= text_.size()) fail(result.begin, "the text has no closing quote; end it with \"");
  ++at_;
  return result;
}

QueryToken QueryLexer::read_regex() {
  QueryToken result{QueryToken::Kind::regex, at_, "", ""};
  for (++at_; at_ < text_.size() && text_[at_] != '/'; ++at_) {
    if (text_[at_] == '\\' && at_ + 1 < text_.size()) {
      ++at_;
      if (text_[at_] != '/') result.text += '\\';
    }
    result.text += text_[at_];
  }
  if (at_ >= text_.size()) fail(result.begin, "the regular expression has no end; close it with /");
  for (++at_; at_ < text_.size() && !ends_word(text_.substr(at_)); ++at_) result.flags += text_[at_];
  return result;
}

QueryToken QueryLexer::read_word() {
  const std::string_view rest = text_.substr(at_);
  if (starts_with_odd_quote(rest)) fail(at_, "a text needs straight double quotes; write \"…\"");
  QueryToken result{rest.front() == '$' ? QueryToken::Kind::variable : QueryToken::Kind::word, at_, "", ""};
  for (; at_ < text_.size() && !ends_word(text_.substr(at_)); ++at_) result.text += text_[at_];
  if (result.text.empty()) {
    fail(at_, fmt::format("'{}' has no meaning here; put a text with such characters in double quotes",
                          printable(rest.substr(0, announced(rest)))));
  }
  return result;
}

}  // namespace signweave
