#include "signweave/notation/utterance.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave {
namespace {

/// One word of the syntax.
struct UtteranceWord {
  std::size_t column = 1;  ///< in bytes, from 1
  std::string text;        ///< without its quotes
  bool quoted = false;     ///< it began with a quote
  std::string suffix;      ///< the text after the closing quote, or "#3" and "@1..2" of a bare word
};

[[noreturn]] void fail(std::string_view what, std::size_t column, std::string_view why) {
  throw Error(ErrorCode::bad_input, fmt::format("{}:1:{}: {}", what, column, why));
}

bool is_blank(char c) noexcept {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

template <typename Number>
std::optional<Number> whole_number(std::string_view text) {
  Number value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || text.front() == '-' || error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return value;
}

/// The begin of "#3" at the end of a bare word. A word that consists of it alone ("#3") is a gloss.
std::size_t token_suffix(std::string_view word) {
  const std::size_t sign = word.rfind('#');
  if (sign == word.npos || sign == 0 || !whole_number<std::size_t>(word.substr(sign + 1))) return word.npos;
  return sign;
}

struct PieceSuffix {
  std::size_t at = std::string_view::npos;
  TimeSpan span;
};

/// "@1200..3400" at the end of a word.
PieceSuffix piece_suffix(std::string_view word) {
  const std::size_t at = word.rfind('@');
  if (at == word.npos) return {};
  const std::size_t dots = word.find("..", at);
  if (dots == word.npos) return {};
  const auto begin = whole_number<std::int64_t>(word.substr(at + 1, dots - at - 1));
  const auto end = whole_number<std::int64_t>(word.substr(dots + 2));
  if (!begin || !end) return {};
  return {at, {Milliseconds(*begin), Milliseconds(*end)}};
}

UtteranceWord next_word(std::string_view text, std::size_t& at, std::string_view what) {
  UtteranceWord word;
  word.column = at + 1;
  if (text[at] == '"') {
    const std::size_t close = text.find('"', at + 1);
    if (close == text.npos) fail(what, word.column, "a quote is opened here and never closed");
    word.quoted = true;
    word.text = text.substr(at + 1, close - at - 1);
    at = close + 1;
    while (at < text.size() && !is_blank(text[at])) word.suffix += text[at++];
    return word;
  }
  while (at < text.size() && !is_blank(text[at])) word.text += text[at++];
  const std::size_t piece = piece_suffix(word.text).at;
  const std::size_t suffix = piece != std::string::npos && piece > 0 ? piece : token_suffix(word.text);
  if (suffix != std::string::npos) {
    word.suffix = word.text.substr(suffix);
    word.text.resize(suffix);
  }
  return word;
}

Place place_of(const UtteranceWord& word, std::string_view what) {
  Place place;
  if (trimmed(word.text).empty()) fail(what, word.column, "an empty name");
  const PieceSuffix piece = piece_suffix(word.suffix);
  if (piece.at == 0) {
    if (piece.span.begin >= piece.span.end)
      fail(what, word.column, "a piece must end after it begins: NAME@BEGIN..END in ms");
    place.kind = Place::Kind::piece;
    place.recording = word.text;
    place.span = piece.span;
    return place;
  }
  place.gloss.gloss = word.text;
  if (word.suffix.empty()) return place;
  const auto token =
      word.suffix.front() == '#' ? whole_number<std::size_t>(std::string_view(word.suffix).substr(1)) : std::nullopt;
  if (!token) {
    fail(what, word.column,
         fmt::format("'{}' after the name is neither #TOKEN nor @BEGIN..END", printable(word.suffix)));
  }
  if (*token == 0) fail(what, word.column, "tokens are counted from 1");
  place.gloss.token = *token;
  return place;
}

/// A name in the form in which it must be typed. (One that contains a quote and needs quotes cannot be typed.)
std::string quoted_if_needed(const std::string& name) {
  const bool bare = !name.empty() && name != "," && name != "." && name.front() != '"' &&
                    std::none_of(name.begin(), name.end(), is_blank) && token_suffix(name) == name.npos &&
                    piece_suffix(name).at == name.npos;
  return bare ? name : '"' + name + '"';
}

}  // namespace

Utterance parse_utterance(std::string_view text) {
  if (text.size() > 1'000'000) fail("utterance", 1, "longer than 1,000,000 bytes");
  Utterance utterance;
  Milliseconds pause{0};
  for (std::size_t at = 0; at < text.size();) {
    if (is_blank(text[at])) {
      ++at;
      continue;
    }
    const UtteranceWord word = next_word(text, at, "utterance");
    if (!word.quoted && word.suffix.empty() && (word.text == "," || word.text == ".")) {
      pause = std::max(pause, word.text == "," ? kComma : kFullStop);
      continue;
    }
    Place place = place_of(word, "utterance");
    if (!utterance.places.empty()) place.pause_before = pause;
    pause = Milliseconds(0);
    utterance.places.push_back(std::move(place));
  }
  if (utterance.places.empty()) fail("utterance", 1, "no sign in it; give glosses separated by blanks");
  return utterance;
}

std::string to_string(const GlossRef& gloss) {
  std::string text = quoted_if_needed(gloss.gloss);
  if (gloss.token > 0) text += fmt::format("#{}", gloss.token);
  return text;
}

std::string to_string(const Utterance& utterance) {
  std::string text;
  for (const Place& place : utterance.places) {
    if (!text.empty()) text += ' ';
    if (place.pause_before > Milliseconds(0)) text += place.pause_before > kComma ? ". " : ", ";
    if (place.kind == Place::Kind::gloss) {
      text += to_string(place.gloss);
    } else {
      text +=
          fmt::format("{}@{}..{}", quoted_if_needed(place.recording), place.span.begin.count(), place.span.end.count());
    }
  }
  return text;
}

GlossRef parse_gloss_ref(std::string_view text, std::string_view what) {
  const std::string_view inner = trimmed(text);
  if (inner.empty()) fail(what, 1, "a gloss is missing");
  // A bare gloss may contain blanks here, because nothing else is separated by them.
  UtteranceWord word;
  if (inner.front() == '"') {
    std::size_t at = 0;
    word = next_word(inner, at, what);
    if (at != inner.size()) fail(what, at + 1, "something follows the quoted gloss");
  } else {
    word.text = inner;
    if (const std::size_t suffix = token_suffix(inner); suffix != inner.npos) {
      word.suffix = inner.substr(suffix);
      word.text = inner.substr(0, suffix);
    }
  }
  const Place place = place_of(word, what);
  if (place.kind != Place::Kind::gloss) fail(what, 1, "expected a gloss, not a piece of a recording");
  return place.gloss;
}

std::size_t find_unquoted(std::string_view text, std::string_view separator, std::size_t from) noexcept {
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (!quoted && i >= from && text.substr(i).starts_with(separator)) return i;
  }
  return text.npos;
}

}  // namespace signweave
