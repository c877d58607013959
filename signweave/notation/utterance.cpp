#include "signweave/notation/utterance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/notation/utterance_word.h"

namespace signweave {
namespace {

using namespace utterances;

/// `begin` is in bytes; the column is in characters.
[[noreturn]] void fail(std::string_view what, std::string_view text, std::size_t begin, std::string_view why) {
  const std::string_view before = text.substr(0, begin);
  const std::size_t feed = before.rfind('\n');
  const std::string_view line = feed == before.npos ? before : before.substr(feed + 1);
  const auto column = std::ranges::count_if(line, [](char c) { return (c & 0xC0) != 0x80; });
  throw Error(ErrorCode::bad_input,
              fmt::format("{}:{}:{}: {}", what, std::ranges::count(before, '\n') + 1, column + 1, why));
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
  static constexpr std::array<std::string_view, kUtteranceFaultKinds> kNames = {
      "open_quote",    "empty_name",    "bad_suffix",         "token_zero",    "piece_order",     "too_long",
      "open_bracket",  "stray_bracket", "nested_bracket",     "too_deep",      "empty_group",     "unknown_part",
      "repeated_part", "bad_option",    "unknown_expression", "bad_sync",      "pause_in_part",   "nothing_to_hold",
      "no_such_place", "long_mouthing", "bad_locus",          "unknown_locus", "repeated_option",
  };
  return kNames[static_cast<std::size_t>(kind)];
}

Utterance parse_utterance(std::string_view text, const UtteranceWords& words) {
  UtteranceText read = read_utterance(text, words);
  if (!read.faults.empty()) fail("utterance", text, read.faults.front().at.begin, read.faults.front().message);
  if (read.utterance.places.empty()) {
    fail("utterance", text, 0, "no sign in it; give glosses separated by blanks");
  }
  return std::move(read.utterance);
}

GlossRef parse_gloss_ref(std::string_view text, std::string_view what) {
  const std::string_view inner = trimmed(text);
  if (inner.empty()) fail(what, inner, 0, "a gloss is missing");
  // A bare gloss may contain blanks and brackets here, because nothing else is separated by them.
  Word word{.at = {0, inner.size()}};
  if (inner.front() == '"') {
    const UtteranceWords none;
    Cursor cursor(inner, none);
    word = cursor.quotation();
    if (word.closed) cursor.at = cursor.run_end(cursor.at, Context::text);
    word.suffix = inner.substr(word.at.end, cursor.at - word.at.end);
    word.at.end = cursor.at;
    if (word.at.end != inner.size()) fail(what, inner, word.at.end, "something follows the quoted gloss");
  } else {
    word.text = inner;
    if (const std::size_t suffix = token_suffix(inner); suffix != inner.npos) {
      word.suffix = inner.substr(suffix);
      word.text = inner.substr(0, suffix);
    }
  }
  const SignReading reading = read_sign(word, inner);
  if (reading.fault) fail(what, inner, reading.fault->at.begin, reading.fault->message);
  if (reading.sign.kind != SignRef::Kind::gloss) fail(what, inner, 0, "expected a gloss, not a piece of a recording");
  return reading.sign.gloss;
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
