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
  WordSpan at;
  std::string text;     ///< without its quotes
  bool quoted = false;  ///< it began with a quote
  bool closed = true;   ///< it ends with the same
  std::string suffix;   ///< the text after the closing quote, or "#3" and "@1..2" of a bare word
};

constexpr std::size_t kMostBytes = 1'000'000;

/// `begin` is in bytes; the column is in characters.
[[noreturn]] void fail(std::string_view what, std::string_view text, std::size_t begin, std::string_view why) {
  const auto before = std::ranges::count_if(text.substr(0, begin), [](char c) { return (c & 0xC0) != 0x80; });
  throw Error(ErrorCode::bad_input, fmt::format("{}:1:{}: {}", what, before + 1, why));
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

UtteranceWord next_word(std::string_view text, std::size_t begin) {
  UtteranceWord word{.at = {begin, begin}};
  std::size_t& at = word.at.end;
  if (text[at] == '"') {
    const std::size_t close = text.find('"', at + 1);
    word.quoted = true;
    word.closed = close != text.npos;
    word.text = text.substr(at + 1, word.closed ? close - at - 1 : text.npos);
    at = word.closed ? close + 1 : text.size();
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

/// What a word of a text asks for, or what is wrong with it.
struct WordReading {
  Place place;
  std::optional<UtteranceFault> fault{};
};

WordReading read_word(const UtteranceWord& word, std::string_view text) {
  using enum UtteranceFault::Kind;
  const auto faulty = [&](UtteranceFault::Kind kind, std::string message, std::string replacement = {}) {
    return WordReading{{}, UtteranceFault{kind, word.at, std::move(message), std::move(replacement)}};
  };
  if (!word.closed) {
    const bool named = !trimmed(word.text).empty();
    const std::string_view written = text.substr(word.at.begin);
    return faulty(open_quote, "a quote is opened here and never closed", named ? std::string(written) + '"' : "");
  }
  if (trimmed(word.text).empty()) return faulty(empty_name, "an empty name");
  WordReading reading;
  Place& place = reading.place;
  const PieceSuffix piece = piece_suffix(word.suffix);
  if (piece.at == 0) {
    if (piece.span.begin >= piece.span.end)
      return faulty(piece_order, "a piece must end after it begins: NAME@BEGIN..END in ms");
    place.kind = Place::Kind::piece;
    place.recording = word.text;
    place.span = piece.span;
    return reading;
  }
  place.gloss.gloss = word.text;
  if (word.suffix.empty()) return reading;
  const auto token =
      word.suffix.front() == '#' ? whole_number<std::size_t>(std::string_view(word.suffix).substr(1)) : std::nullopt;
  if (!token) {
    return faulty(bad_suffix,
                  fmt::format("'{}' after the name is neither #TOKEN nor @BEGIN..END", printable(word.suffix)));
  }
  if (*token == 0) {
    const std::size_t length = word.at.end - word.at.begin - word.suffix.size();
    return faulty(token_zero, "tokens are counted from 1", std::string(text.substr(word.at.begin, length)));
  }
  place.gloss.token = *token;
  return reading;
}

/// A name in the form in which it must be typed. (One that contains a quote and needs quotes cannot be typed.)
std::string quoted_if_needed(const std::string& name) {
  const bool bare = !name.empty() && name != "," && name != "." && name.front() != '"' &&
                    std::none_of(name.begin(), name.end(), is_blank) && token_suffix(name) == name.npos &&
                    piece_suffix(name).at == name.npos;
  return bare ? name : '"' + name + '"';
}

}  // namespace

std::string_view name_of(BodyPart part) noexcept {
  switch (part) {
    case BodyPart::dominant:
      return "dominant";
    case BodyPart::weak:
      return "weak";
    case BodyPart::right:
      return "right";
    case BodyPart::left:
      return "left";
    case BodyPart::dominant_fingers:
      return "dominant fingers";
    case BodyPart::weak_fingers:
      return "weak fingers";
    case BodyPart::right_fingers:
      return "right fingers";
    case BodyPart::left_fingers:
      return "left fingers";
    case BodyPart::head:
      return "head";
  }
  return "";
}

std::string_view name_of(UtteranceFault::Kind kind) noexcept {
  switch (kind) {
    case UtteranceFault::Kind::open_quote:
      return "open_quote";
    case UtteranceFault::Kind::empty_name:
      return "empty_name";
    case UtteranceFault::Kind::bad_suffix:
      return "bad_suffix";
    case UtteranceFault::Kind::token_zero:
      return "token_zero";
    case UtteranceFault::Kind::piece_order:
      return "piece_order";
    case UtteranceFault::Kind::too_long:
      return "too_long";
  }
  return "";
}

UtteranceText read_utterance(std::string_view text) {
  UtteranceText read;
  if (text.size() > kMostBytes) {
    read.faults.push_back({UtteranceFault::Kind::too_long, {0, text.size()}, "longer than 1,000,000 bytes", {}});
    return read;
  }
  std::vector<Place>& places = read.utterance.places;
  Milliseconds pause{0};
  for (std::size_t at = 0; at < text.size();) {
    if (is_blank(text[at])) {
      ++at;
      continue;
    }
    const UtteranceWord word = next_word(text, at);
    at = word.at.end;
    if (!word.quoted && word.suffix.empty() && (word.text == "," || word.text == ".")) {
      pause = std::max(pause, word.text == "," ? kComma : kFullStop);
      continue;
    }
    WordReading reading = read_word(word, text);
    if (reading.fault) {
      if (read.faults.size() < kMostUtteranceFaults) read.faults.push_back(std::move(*reading.fault));
      continue;
    }
    if (!places.empty()) reading.place.pause_before = pause;
    pause = Milliseconds(0);
    places.push_back(std::move(reading.place));
    read.spans.push_back(word.at);
  }
  read.pause_after = pause;
  return read;
}

Utterance parse_utterance(std::string_view text) {
  UtteranceText read = read_utterance(text);
  if (!read.faults.empty()) fail("utterance", text, read.faults.front().at.begin, read.faults.front().message);
  if (read.utterance.places.empty()) {
    fail("utterance", text, 0, "no sign in it; give glosses separated by blanks");
  }
  return std::move(read.utterance);
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
  if (inner.empty()) fail(what, inner, 0, "a gloss is missing");
  // A bare gloss may contain blanks here, because nothing else is separated by them.
  UtteranceWord word;
  if (inner.front() == '"') {
    word = next_word(inner, 0);
    if (word.at.end != inner.size()) fail(what, inner, word.at.end, "something follows the quoted gloss");
  } else {
    word.at.end = inner.size();
    word.text = inner;
    if (const std::size_t suffix = token_suffix(inner); suffix != inner.npos) {
      word.suffix = inner.substr(suffix);
      word.text = inner.substr(0, suffix);
    }
  }
  const WordReading reading = read_word(word, inner);
  if (reading.fault) fail(what, inner, reading.fault->at.begin, reading.fault->message);
  if (reading.place.kind != Place::Kind::gloss) fail(what, inner, 0, "expected a gloss, not a piece of a recording");
  return reading.place.gloss;
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
