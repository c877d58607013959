#include "signweave/notation/utterance_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "signweave/core/text.h"
#include "signweave/notation/utterance_space.h"

namespace signweave::utterances {
namespace {

using enum UtteranceFault::Kind;

bool none_quoted(std::span<const OptionToken> tokens) {
  return std::ranges::none_of(tokens, &OptionToken::quoted);
}
std::optional<BodyPart> part_of(std::span<const OptionToken> tokens) {
  if (tokens.empty() || tokens.size() > 2 || !none_quoted(tokens)) return std::nullopt;
  return body_part_of(joined(tokens));
}

class OptionsReader {
 public:
  OptionsReader(Cursor& cursor, OptionsOf of) : cursor_(cursor), of_(of) {}
  Options read();

 private:
  bool at_label() const { return cursor_.here() == ':'; }
  bool at_end_of_option() const { return !cursor_.ended() && closes(cursor_.here(), Context::label); }
  void fault(const RawOption& raw, std::string message, std::string replacement = {}) {
    cursor_.report(bad_option, raw.at, std::move(message), std::move(replacement));
  }
  std::optional<RawOption> read_raw();
  bool skip_colon(const RawOption& raw);
  bool read_token(RawOption& raw);
  bool read_extent(RawOption& raw);
  void read_labelled(const RawOption& raw);
  void interpret(RawOption raw);
  bool interpret_hand(const RawOption& raw);
  void interpret_hold(const RawOption& raw, BodyPart hand);
  void interpret_non_manual(const RawOption& raw);
  bool take_offsets(RawOption& raw, NonManual& non_manual);
  bool take_what(const RawOption& raw, NonManual& non_manual);
  bool take_gaze(const RawOption& raw, NonManual& non_manual);
  bool take_mouthing(const RawOption& raw, NonManual& non_manual);
  bool take_expression(const RawOption& raw, NonManual& non_manual);
  void report_unknown_expression(const RawOption& raw, const std::string& name);

  Cursor& cursor_;
  OptionsOf of_;
  Options options_;
};

/// Reads `..`, `..+2` or `..GLOSS`. False if nothing more can be read.
bool OptionsReader::read_extent(RawOption& raw) {
  const std::size_t begin = cursor_.at;
  cursor_.at += 2;
  Extent extent;
  const bool labels = of_ == OptionsOf::scope || part_of(raw.tokens).has_value();
  const Context context = labels ? Context::label : Context::option;
  if (!cursor_.ends_word() && !closes(cursor_.here(), context)) {
    const Word word = cursor_.word(context);
    if (!word.closed) {
      cursor_.report(std::move(*read_sign(word, cursor_.text()).fault));
      options_.end = Options::End::open_quote;
      return false;
    }
    if (!word.literal && word.text.find_first_of("[]{") == 0) return false;
    const auto count = word.literal || word.text.front() != '+' || !word.suffix.empty()
                           ? std::nullopt
                           : whole_number(std::string_view(word.text).substr(1));
    SignReading sign = read_sign(word, cursor_.text());
    if (count) {
      extent.kind = Extent::Kind::count;
      extent.count = *count;
    } else if (sign.fault || sign.sign.kind == SignRef::Kind::piece) {
      raw.faulty = true;
      if (sign.fault) {
        cursor_.report(std::move(*sign.fault));
      } else {
        cursor_.report(bad_option, word.at, "a piece cannot end it; name a gloss or a count: ..GLOSS or ..+2");
      }
    } else {
      extent.kind = Extent::Kind::named;
      extent.name = std::move(sign.sign.gloss);
    }
  }
  extent.at = {begin, cursor_.at};
  if (raw.extent) {
    raw.faulty = true;
    cursor_.report(bad_option, extent.at, "a second end of the same option; keep one of them");
  }
  raw.extent = std::move(extent);
  return true;
}

/// Reads one word of an option. False if nothing more can be read.
bool OptionsReader::read_token(RawOption& raw) {
  const std::string_view text = cursor_.text();
  const std::size_t begin = cursor_.at;
  if (text[begin] == '"') {
    const Word word = cursor_.quotation();
    if (!word.closed) {
      cursor_.report(std::move(*read_sign(word, text).fault));
      options_.end = Options::End::open_quote;
      return false;
    }
    raw.tokens.push_back({word.text, true, word.at});
    return true;
  }
  if (text.substr(begin).starts_with("..")) return read_extent(raw);
  while (!cursor_.ends_word() && std::string_view("[]{};:\"").find(text[cursor_.at]) == std::string_view::npos)
    ++cursor_.at;
  if (cursor_.at == begin) return false;  // a bracket
  raw.tokens.push_back({std::string(text.substr(begin, cursor_.at - begin)), false, {begin, cursor_.at}});
  return true;
}

/// Skips the colon of "from: @left" and the blanks behind it; false if none is here.
bool OptionsReader::skip_colon(const RawOption& raw) {
  if (of_ == OptionsOf::scope || !at_label() || !may_have_colon(raw)) return false;
  const std::size_t colon = cursor_.at;
  ++cursor_.at;
  cursor_.skip_blanks();
  if (cursor_.here() == '@') return true;
  cursor_.at = colon;
  return false;
}

/// Reads up to what closes the option; none if nothing does.
std::optional<RawOption> OptionsReader::read_raw() {
  RawOption raw;
  cursor_.skip_blanks();
  raw.at = {cursor_.at, cursor_.at + 1};
  while (!at_end_of_option() || skip_colon(raw)) {
    if (cursor_.ended() || !read_token(raw)) return std::nullopt;
    raw.at.end = cursor_.at;
    cursor_.skip_blanks();
  }
  return raw;
}

/// Reads the signs of a part, which the option `raw` names; the cursor is at the colon.
void OptionsReader::read_labelled(const RawOption& raw) {
  const auto part = part_of(raw.tokens);
  if (!part) {
    report_unknown_part(cursor_, raw.at, joined(raw.tokens));
    cursor_.skip_to(Context::option);
    return;
  }
  ++cursor_.at;
  PartReading reading = read_part(cursor_, Context::option);
  if (reading.hold && reading.sound) {
    cursor_.report(bad_option, {raw.at.begin, reading.hold->end},
                   fmt::format("in options say until when it holds: {} hold ..GLOSS", name_of(*part)));
  }
  if (reading.hold || !reading.sound || raw.faulty || !check_rest(cursor_, reading, *part, raw.at.begin)) return;
  options_.parts.push_back({*part, std::move(reading.signs), raw.extent, {raw.at.begin, cursor_.at}});
}

void OptionsReader::interpret_hold(const RawOption& raw, BodyPart hand) {
  if (of_ == OptionsOf::scope) {
    fault(raw, "a hold belongs to the place at whose end it begins: A{weak hold ..C}");
  } else if (!is_hand(hand)) {
    fault(raw, fmt::format("'{}' cannot be held; a hand can: dominant, weak, right or left", name_of(hand)));
  } else if (!raw.extent) {
    fault(raw, fmt::format("say until when it holds: {} hold ..GLOSS, or .. for the last place", name_of(hand)));
  } else {
    options_.holds.push_back({hand, *raw.extent, raw.at});
  }
}

/// Interprets options that begin with a hand or fingers. False if this one does not.
bool OptionsReader::interpret_hand(const RawOption& raw) {
  const std::span<const OptionToken> tokens = raw.tokens;
  const auto begins = [&](std::string_view word) { return tokens.front().is(word); };
  if (tokens.back().is("hold")) {
    if (const auto hand = part_of(tokens.first(tokens.size() - 1))) {
      interpret_hold(raw, *hand);
      return true;
    }
  }
  if (begins("dominant") && tokens.size() == 2 && (tokens[1].is("left") || tokens[1].is("right"))) {
    if (options_.dominant) {
      cursor_.report(repeated_part, raw.at, "the dominant hand is given twice; keep one");
    } else if (raw.extent) {
      fault(raw, "the dominant hand has no end of its own; use a scope: {dominant left: A B}");
    } else {
      options_.dominant = tokens[1].is("left") ? Side::left : Side::right;
    }
    return true;
  }
  const std::array<std::string_view, 5> reserved = {"dominant", "weak", "right", "left", "fingers"};
  if (std::ranges::none_of(reserved, begins)) return false;
  if (of_ == OptionsOf::scope) {
    fault(raw, "a scope has no parts; those of a place stand directly behind its sign: A{weak: B}");
    return true;
  }
  fault(raw, fmt::format("'{}' is no option; a part has a colon and signs, as in weak: B, and a hold an end, as in "
                         "weak hold ..C",
                         printable(joined(tokens))));
  return true;
}

/// Takes up to two offsets from the end of an option. False if they cannot be read; reports why.
bool OptionsReader::take_offsets(RawOption& raw, NonManual& non_manual) {
  std::vector<Milliseconds> offsets;
  while (raw.tokens.size() > 1) {
    const OptionToken& token = raw.tokens.back();
    if (token.quoted || token.text.find_first_of("+-") != 0) break;
    const auto offset = offset_of(token.text);
    if (!offset) {
      cursor_.report(bad_option, token.at,
                     fmt::format("'{}' is no offset such as +0 or -40, in ms, at most {}", printable(token.text),
                                 kMostUtteranceOffset.count()));
      return false;
    }
    offsets.insert(offsets.begin(), *offset);
    raw.tokens.pop_back();
  }
  if (offsets.size() > 2) {
    fault(raw, "more than two offsets; give those of its begin and of its end: +0 -40");
    return false;
  }
  if (!offsets.empty()) non_manual.begin = offsets[0];
  if (offsets.size() == 2) non_manual.end = offsets[1];
  return true;
}

bool OptionsReader::take_gaze(const RawOption& raw, NonManual& non_manual) {
  const std::span<const OptionToken> tokens = raw.tokens;
  non_manual.kind = NonManual::Kind::gaze;
  if (tokens.size() == 2 && !tokens[1].quoted && tokens[1].text.size() > 1 && tokens[1].text.front() == '@') {
    non_manual.what = tokens[1].text.substr(1);
    return true;
  }
  if (tokens.size() == 3 && tokens[1].is("@") && tokens[2].quoted && tokens[1].at.end == tokens[2].at.begin &&
      !trimmed(tokens[2].text).empty()) {
    non_manual.what = tokens[2].text;
    return true;
  }
  const bool word = tokens.size() == 2 && !tokens[1].quoted && tokens[1].text != "@";
  fault(raw, "a gaze has a direction: gaze @left or gaze @addressee", word ? "gaze @" + tokens[1].text : "");
  return false;
}

bool OptionsReader::take_mouthing(const RawOption& raw, NonManual& non_manual) {
  const std::span<const OptionToken> tokens = raw.tokens;
  non_manual.kind = NonManual::Kind::mouthing;
  if (tokens.size() != 2 || !tokens[1].quoted) {
    const bool words = tokens.size() > 1 && none_quoted(tokens);
    fault(raw, "a mouthing has its text in quotes: mouth \"pluie\"",
          words ? "mouth " + in_quotes(joined(tokens.subspan(1))) : "");
    return false;
  }
  non_manual.what = tokens[1].text;
  const auto length = std::ranges::count_if(non_manual.what, [](char c) { return (c & 0xC0) != 0x80; });
  if (static_cast<std::size_t>(length) > kMostMouthingCharacters) {
    cursor_.report(long_mouthing, tokens[1].at,
                   fmt::format("a mouthing of {} characters; the limit is {}", length, kMostMouthingCharacters));
    return false;
  }
  if (!trimmed(non_manual.what).empty()) return true;
  cursor_.report(empty_name, tokens[1].at, "a mouthing without text");
  return false;
}

bool OptionsReader::take_expression(const RawOption& raw, NonManual& non_manual) {
  const std::span<const OptionToken> tokens = raw.tokens;
  if (tokens.size() > 1 && !none_quoted(tokens)) {
    fault(raw, "words in quotes and others are mixed here; separate options by ';'");
    return false;
  }
  const auto marks = [](const OptionToken& token) { return !token.quoted && token.text.find_first_of("@+") == 0; };
  if (const auto mark = std::ranges::find_if(tokens, marks); mark != tokens.end()) {
    cursor_.report(
        bad_option, mark->at,
        fmt::format("'{}' belongs to no option such as gaze @left or brows up +0 -40", printable(mark->text)));
    return false;
  }
  non_manual.what = joined(tokens);
  if (trimmed(non_manual.what).empty()) {
    fault(raw, "an empty name of an expression");
    return false;
  }
  if (!cursor_.words().is_expression || cursor_.words().is_expression(non_manual.what)) return true;
  report_unknown_expression(raw, non_manual.what);
  return false;
}

void OptionsReader::report_unknown_expression(const RawOption& raw, const std::string& name) {
  const WordSpan at{raw.tokens.front().at.begin, raw.tokens.back().at.end};
  std::vector<std::string> near;
  if (cursor_.words().near_expressions) near = cursor_.words().near_expressions(name);
  if (near.empty()) {
    return cursor_.report(
        unknown_expression, at,
        fmt::format("no expression '{}'; name one that exists, or quote the word if it is a gloss", printable(name)));
  }
  const bool split = raw.extent && raw.extent->at.begin < at.end;  // by its end
  cursor_.report(unknown_expression, at,
                 fmt::format("no expression '{}'; did you mean {}?", printable(name), either_of(near)),
                 near.size() == 1 && !split ? expression_text(near.front()) : std::string());
}

bool OptionsReader::take_what(const RawOption& raw, NonManual& non_manual) {
  if (raw.tokens.front().is("gaze")) return take_gaze(raw, non_manual);
  if (raw.tokens.front().is("mouth")) return take_mouthing(raw, non_manual);
  return take_expression(raw, non_manual);
}

void OptionsReader::interpret(RawOption raw) {
  if (raw.faulty) return;
  if (raw.tokens.empty()) return fault(raw, "an option is missing here; give one, such as brows up");
  if (interpret_hand(raw) || read_space_option(cursor_, raw, of_, options_.space)) return;
  NonManual non_manual;
  if (!take_offsets(raw, non_manual) || !take_what(raw, non_manual)) return;
  if (raw.extent && of_ == OptionsOf::scope) return fault(raw, "a scope ends with its last place; leave out the '..'");
  options_.non_manuals.push_back({std::move(non_manual), raw.extent});
}

Options OptionsReader::read() {
  for (;;) {
    std::optional<RawOption> raw = read_raw();
    if (!raw) return std::move(options_);
    if (at_label() && of_ == OptionsOf::place) {
      read_labelled(*raw);
      if (cursor_.ended()) return std::move(options_);
    } else {
      const bool last = at_label();
      interpret(std::move(*raw));
      if (last || (of_ == OptionsOf::scope && cursor_.here() == '}')) {
        if (last) options_.end = Options::End::complete;
        if (last) ++cursor_.at;
        return std::move(options_);
      }
    }
    const char close = cursor_.here();
    ++cursor_.at;
    if (close != '}') continue;
    options_.end = Options::End::complete;
    return std::move(options_);
  }
}

}  // namespace

std::string joined(std::span<const OptionToken> tokens) {
  std::string text;
  for (const OptionToken& token : tokens) text += (text.empty() ? "" : " ") + token.text;
  return text;
}

Options read_options(Cursor& cursor, OptionsOf of) {
  return OptionsReader(cursor, of).read();
}

}  // namespace signweave::utterances
