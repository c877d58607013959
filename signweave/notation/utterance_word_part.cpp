#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "signweave/core/text.h"
#include "signweave/notation/utterance_word.h"

namespace signweave::utterances {
namespace {

using enum UtteranceFault::Kind;

constexpr std::size_t kLongestLabel = 40;  // for which a part is suggested

/// Reads the sync mark `word` into the last sign of a part. False if it is none; reports why.
bool read_sync(Cursor& cursor, const Word& word, std::vector<PartSign>& signs) {
  const std::string_view mark = std::string_view(word.text).substr(1);
  SyncMark sync;
  std::string_view offset;
  if (mark.starts_with("begin")) {
    offset = mark.substr(5);
  } else if (mark.starts_with("end")) {
    sync.anchor = SyncMark::Anchor::end;
    offset = mark.substr(3);
  } else {
    offset = "?";
  }
  const auto time = offset.empty() ? Milliseconds(0) : offset_of(offset);
  if (!time || !word.suffix.empty()) {
    cursor.report(bad_sync, word.at,
                  fmt::format("'{}' is no sync mark such as @begin, @begin+200 or @end-100; quote it if it is a gloss",
                              printable(word.text + word.suffix)),
                  in_quotes(word.text + word.suffix));
    return false;
  }
  if (signs.empty()) {
    cursor.report(bad_sync, word.at, "a sync mark belongs behind the sign of a part: weak: B @begin+200");
    return false;
  }
  if (signs.back().rest) {
    cursor.report(bad_sync, word.at, "a rest has no sync mark; it lasts until the next sign of its hand");
    return false;
  }
  std::vector<SyncMark>& marks = signs.back().sync;
  if (std::ranges::find(marks, sync.anchor, &SyncMark::anchor) != marks.end()) {
    cursor.report(bad_sync, word.at, "this sign has such a sync mark already; keep one of them");
    return false;
  }
  sync.offset = *time;
  marks.push_back(sync);
  return true;
}

/// Reads one word of a part.
void read_part_word(Cursor& cursor, Context context, PartReading& reading) {
  const std::size_t begin = cursor.at;
  const Word word = cursor.word(context);
  const bool bare = !word.literal;
  if (bare && word.text.size() == 1 && word.text.find_first_of("[]{}") == 0) {
    if (word.text == "[" || word.text == "{") cursor.at = begin;
    cursor.report_unquoted(stray_bracket, begin, context,
                           "a part has only signs; close what is open, or quote the word if it is a gloss");
  } else if (!cursor.ends_word() && !closes(cursor.here(), context)) {
    cursor.report_unquoted(
        stray_bracket, begin, context,
        "a sign of a part has no options; leave the bracket out, or quote the word if it is a gloss");
  } else if (word.is_pause()) {
    cursor.report(pause_in_part, word.at, "a part has no pauses; give its sign a sync mark such as @begin+350");
  } else if (bare && word.text == "hold" && word.suffix.empty()) {
    if (reading.hold || !reading.signs.empty())
      cursor.report(bad_option, word.at, "a hold is alone in its part; quote it if it is a gloss", "\"hold\"");
    reading.hold = word.at;
  } else if (bare && word.text == "rest" && word.suffix.empty()) {
    if (!reading.rest) reading.rest = word.at;
    reading.signs.push_back({.sign = {}, .sync = {}, .rest = true});
  } else if (bare && word.text.front() == '@') {
    read_sync(cursor, word, reading.signs);
  } else {
    SignReading sign = read_sign(word, cursor.text());
    if (sign.fault) {
      cursor.report(std::move(*sign.fault));
    } else {
      reading.signs.push_back({.sign = std::move(sign.sign), .sync = {}});
    }
  }
}

}  // namespace

PartReading read_part(Cursor& cursor, Context context) {
  PartReading reading;
  const std::size_t faults = cursor.fault_count();
  const std::size_t begin = cursor.at;
  for (;;) {
    cursor.skip_blanks();
    if (cursor.ended() || closes(cursor.here(), context)) break;
    read_part_word(cursor, context, reading);
  }
  if (cursor.fault_count() == faults && reading.hold && !reading.signs.empty()) {
    cursor.report(bad_option, *reading.hold, "a hold is alone in its part; quote it if it is a gloss", "\"hold\"");
  }
  if (cursor.fault_count() == faults && !cursor.ended() && !reading.hold && reading.signs.empty()) {
    cursor.report(empty_group, {begin - 1, cursor.at}, "a part without a sign; give one behind the colon");
  }
  reading.sound = cursor.fault_count() == faults;
  return reading;
}

std::optional<BodyPart> body_part_of(std::string_view label) {
  std::string name;  // with single blanks
  for (const char c : trimmed(label)) {
    if (!is_blank(c)) {
      name += c;
    } else if (name.back() != ' ') {
      name += ' ';
    }
    if (name.size() > kLongestLabel) return std::nullopt;
  }
  if (name == "fingers") return BodyPart::dominant_fingers;
  if (name.starts_with("fingers ")) name = name.substr(8) + " fingers";
  for (const BodyPart part : kBodyParts) {
    if (name == name_of(part)) return part;
  }
  return std::nullopt;
}

bool is_hand(BodyPart part) noexcept {
  return part == BodyPart::dominant || part == BodyPart::weak || part == BodyPart::right || part == BodyPart::left;
}

bool check_rest(Cursor& cursor, const PartReading& reading, BodyPart part, std::size_t begin) {
  if (!reading.rest || is_hand(part)) return true;
  cursor.report(
      bad_option, {begin, reading.rest->end},
      fmt::format("'{}' cannot rest; a hand can: dominant, weak, right or left. Quote the word if it is a gloss",
                  name_of(part)));
  return false;
}

std::optional<Milliseconds> offset_of(std::string_view text) {
  if (text.size() < 2 || (text.front() != '+' && text.front() != '-')) return std::nullopt;
  const auto size = whole_number(text.substr(1));
  if (!size || *size > static_cast<std::size_t>(kMostUtteranceOffset.count())) return std::nullopt;
  const Milliseconds offset(static_cast<std::int64_t>(*size));
  return text.front() == '-' ? -offset : offset;
}

void report_unknown_part(Cursor& cursor, WordSpan span, std::string_view label) {
  std::vector<std::string> known;
  for (const BodyPart part : kBodyParts) known.emplace_back(name_of(part));
  std::vector<std::string> near;
  if (label.size() <= kLongestLabel) near = near_matches(label, known);
  cursor.report(unknown_part, span,
                fmt::format("no part '{}'; a part is one of {}", printable(label), either_of(known)),
                near.empty() ? std::string() : near.front());
}

}  // namespace signweave::utterances
