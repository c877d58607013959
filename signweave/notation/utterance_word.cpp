#include "signweave/notation/utterance_word.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "signweave/core/text.h"

namespace signweave::utterances {
namespace {

constexpr std::size_t kLongestBareGloss = 1'000;  // in bytes: of those with brackets
constexpr std::size_t kMostBareEnds = 16;         // ends of a word that are tried

struct CharClass {
  bool blank = false;
  bool ends = false;  ///< a word of the context
};
using CharClasses = std::array<CharClass, 256>;

constexpr CharClasses classes_of(std::string_view characters) {
  CharClasses classes{};
  for (const char c : std::string_view(" \t\n\v\f\r")) classes[static_cast<unsigned char>(c)].blank = true;
  for (const char c : characters) classes[static_cast<unsigned char>(c)].ends = true;
  return classes;
}
constexpr std::array<CharClasses, 5> kClasses = {classes_of("[]{}"), classes_of("[]{}"), classes_of("[]{}|"),
                                                 classes_of("[]{};"), classes_of("[]{};:")};
constexpr std::array<std::string_view, 5> kClosing = {"", "}", "|]", ";}", ";}:"};

const CharClasses& classes(Context context) {
  return kClasses[static_cast<std::size_t>(context)];
}
CharClass class_of(char c, const CharClasses& classes) {
  return classes[static_cast<unsigned char>(c)];
}

std::optional<std::int64_t> piece_time(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || text.front() == '-' || error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return value;
}

/// The quote that ends the quotation from `begin`, or npos. Two quotes in it are one of its text.
std::size_t closing_quote(std::string_view text, std::size_t begin) {
  std::size_t close = text.find('"', begin + 1);
  while (close != text.npos && close + 1 < text.size() && text[close + 1] == '"') close = text.find('"', close + 2);
  return close;
}

std::string with_single_quotes(std::string_view inner) {
  std::string text;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    text += inner[i];
    if (inner[i] == '"' && i + 1 < inner.size() && inner[i + 1] == '"') ++i;
  }
  return text;
}

/// True for words that are no gloss in a part.
bool is_keyword(std::string_view name) noexcept {
  return name == "hold" || name == "rest";
}

/// Whether a quote here may begin a quotation, for skipping over text that cannot be read.
bool begins_quotation(std::string_view text, std::size_t at) {
  return text[at] == '"' &&
         (at == 0 || is_blank(text[at - 1]) || std::string_view("[{|:;.@").find(text[at - 1]) != text.npos);
}

}  // namespace

bool is_blank(char c) noexcept {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

bool closes(char c, Context context) noexcept {
  return kClosing[static_cast<std::size_t>(context)].find(c) != std::string_view::npos;
}

std::optional<std::size_t> whole_number(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::size_t token_suffix(std::string_view word) {
  const std::size_t sign = word.rfind('#');
  if (sign == word.npos || sign == 0 || !whole_number(word.substr(sign + 1))) return word.npos;
  return sign;
}

PieceSuffix piece_suffix(std::string_view word) {
  const std::size_t at = word.rfind('@');
  if (at == word.npos) return {};
  const std::size_t dots = word.find("..", at);
  if (dots == word.npos) return {};
  const auto begin = piece_time(word.substr(at + 1, dots - at - 1));
  const auto end = piece_time(word.substr(dots + 2));
  if (!begin || !end) return {};
  return {at, {Milliseconds(*begin), Milliseconds(*end)}};
}

SignReading read_sign(const Word& word, std::string_view text) {
  using enum UtteranceFault::Kind;
  const auto faulty = [&](UtteranceFault::Kind kind, std::string message, std::string replacement = {}) {
    return SignReading{{}, UtteranceFault{kind, word.at, std::move(message), std::move(replacement)}};
  };
  if (!word.closed) {
    const bool named = !trimmed(word.text).empty();
    const std::string_view written = text.substr(word.at.begin);
    return faulty(open_quote, "a quote is opened here and never closed", named ? std::string(written) + '"' : "");
  }
  if (trimmed(word.text).empty()) return faulty(empty_name, "an empty name");
  SignReading reading;
  SignRef& sign = reading.sign;
  if (word.suffix.empty()) {
    sign.gloss.gloss = word.text;
    return reading;
  }
  const PieceSuffix piece = piece_suffix(word.suffix);
  if (piece.at == 0) {
    if (piece.span.begin >= piece.span.end)
      return faulty(piece_order, "a piece must end after it begins: NAME@BEGIN..END in ms");
    sign.kind = SignRef::Kind::piece;
    sign.recording = word.text;
    sign.span = piece.span;
    return reading;
  }
  sign.gloss.gloss = word.text;
  const auto token = word.suffix.front() == '#' ? whole_number(std::string_view(word.suffix).substr(1)) : std::nullopt;
  if (!token) {
    return faulty(bad_suffix,
                  fmt::format("'{}' after the name is neither #TOKEN nor @BEGIN..END", printable(word.suffix)));
  }
  if (*token == 0) {
    const std::size_t length = word.at.end - word.at.begin - word.suffix.size();
    return faulty(token_zero, "tokens are counted from 1", std::string(text.substr(word.at.begin, length)));
  }
  sign.gloss.token = *token;
  return reading;
}

std::string in_quotes(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) {
    text += c;
    if (c == '"') text += c;
  }
  return text + '"';
}

std::string quoted_if_needed(std::string_view name) {
  const bool bare = !name.empty() && name != "," && name != "." && name.front() != '"' &&
                    std::none_of(name.begin(), name.end(), is_blank) && name.find_first_of("[]{}") == name.npos &&
                    token_suffix(name) == name.npos && piece_suffix(name).at == name.npos;
  return bare ? std::string(name) : in_quotes(name);
}

std::string quoted_if_needed_inside(std::string_view name) {
  const bool syntax = name.find_first_of("|;") != name.npos || name.starts_with('@') || is_keyword(name);
  return syntax ? in_quotes(name) : quoted_if_needed(name);
}

void Cursor::skip_blanks() noexcept {
  while (at < text_.size() && is_blank(text_[at])) ++at;
}

std::optional<Word> Cursor::known_gloss(std::size_t begin, std::size_t end, Context context) const {
  const CharClasses& known = classes(context);
  std::array<std::size_t, kMostBareEnds> ends{};
  std::size_t count = 0;
  const std::size_t most = std::min(text_.size(), begin + kLongestBareGloss);
  for (; count < ends.size() && end <= most; ++end) {
    const CharClass next = end < text_.size() ? class_of(text_[end], known) : CharClass{.blank = true};
    if (end > begin && (next.ends || next.blank)) ends[count++] = end;
    if (next.blank) break;
  }
  while (count > 0) {
    const std::string_view name = text_.substr(begin, ends[--count] - begin);
    Word word{.at = {begin, begin + name.size()}, .text = std::string(name), .literal = true};
    if (words_.is_gloss(name)) return word;
    const std::size_t token = token_suffix(name);
    if (token == name.npos || !words_.is_gloss(name.substr(0, token))) continue;
    word.suffix = name.substr(token);
    word.text.resize(token);
    return word;
  }
  return std::nullopt;
}

Word Cursor::quotation() {
  Word word{.at = {at, text_.size()}, .quoted = true, .literal = true};
  const std::size_t close = closing_quote(text_, at);
  word.closed = close != text_.npos;
  word.text = with_single_quotes(text_.substr(at + 1, word.closed ? close - at - 1 : text_.npos));
  if (word.closed) word.at.end = close + 1;
  at = word.at.end;
  return word;
}

Word Cursor::word(Context context) {
  const CharClasses& known = classes(context);
  const std::size_t begin = at;
  if (text_[begin] == '"') {
    Word word = quotation();
    const std::size_t suffix = at;
    while (at < text_.size() && !is_blank(text_[at]) && !class_of(text_[at], known).ends) ++at;
    word.suffix = text_.substr(suffix, at - suffix);
    word.at.end = at;
    return word;
  }
  std::size_t end = begin;
  CharClass next{};
  for (; end < text_.size(); ++end) {
    next = class_of(text_[end], known);
    if (next.blank || next.ends) break;
  }
  const std::string_view name = text_.substr(begin, end - begin);
  const bool unclear = next.ends || (context != Context::text && (name.starts_with('@') || is_keyword(name)));
  if (unclear && words_.is_gloss) {
    if (std::optional<Word> gloss = known_gloss(begin, end, context)) {
      at = gloss->at.end;
      return std::move(*gloss);
    }
  }
  at = std::max(end, begin + 1);
  Word word{.at = {begin, at}, .text = std::string(text_.substr(begin, at - begin))};
  const std::size_t piece = piece_suffix(word.text).at;
  const std::size_t suffix = piece != std::string::npos && piece > 0 ? piece : token_suffix(word.text);
  if (suffix != std::string::npos) {
    word.suffix = word.text.substr(suffix);
    word.text.resize(suffix);
  }
  return word;
}

std::size_t Cursor::run_end(std::size_t from, Context context) const noexcept {
  while (from < text_.size() && !is_blank(text_[from]) && !closes(text_[from], context)) ++from;
  return from;
}

void Cursor::skip_to(Context context) noexcept {
  while (at < text_.size() && !closes(text_[at], context)) {
    if (begins_quotation(text_, at)) at = std::min(closing_quote(text_, at), text_.size() - 1);
    ++at;
  }
}

bool Cursor::skip_brackets() {
  std::size_t depth = 0;
  for (std::size_t i = at; i < text_.size(); ++i) {
    const char c = text_[i];
    if (begins_quotation(text_, i)) {
      i = closing_quote(text_, i);
      if (i == text_.npos) return false;
    } else if (c == '[' || c == '{') {
      if (++depth <= kMostUtteranceDepth) continue;
      report(UtteranceFault::Kind::too_deep, {i, i + 1},
             fmt::format("more than {} brackets inside each other; use fewer", kMostUtteranceDepth));
      stopped = true;
      at = text_.size();
      return true;
    } else if ((c == ']' || c == '}') && --depth == 0) {
      at = i + 1;
      return true;
    }
  }
  return false;
}

void Cursor::report(UtteranceFault fault) {
  ++count_;
  if (faults_.size() < kMostUtteranceFaults) faults_.push_back(std::move(fault));
}

void Cursor::report(UtteranceFault::Kind kind, WordSpan span, std::string message, std::string replacement) {
  report({kind, span, std::move(message), std::move(replacement)});
}

void Cursor::report_unquoted(UtteranceFault::Kind kind, std::size_t begin, Context context, std::string message) {
  if ((here() == '[' || here() == '{') && skip_brackets()) {
    if (stopped) return;
    at = run_end(at, context);
  } else {
    at = run_end(begin + 1, context);
  }
  const std::string_view run = text_.substr(begin, at - begin);
  const bool word = run.front() != '"' && std::ranges::none_of(run, is_blank);
  report(kind, {begin, at}, std::move(message), word ? in_quotes(run) : std::string());
}

void Cursor::go_back(std::size_t position, std::size_t faults) {
  at = position;
  count_ = faults;
  if (faults < faults_.size()) faults_.resize(faults);
}

}  // namespace signweave::utterances
