#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "signweave/notation/utterance.h"
#include "signweave/notation/utterance_ends.h"
#include "signweave/notation/utterance_options.h"
#include "signweave/notation/utterance_space.h"
#include "signweave/notation/utterance_word.h"

namespace signweave {
namespace {

using namespace utterances;
using enum UtteranceFault::Kind;

constexpr std::size_t kMostBytes = 1'000'000;

struct GroupPart {
  BodyPart part = BodyPart::weak;
  std::vector<PartSign> signs;
  std::optional<WordSpan> hold;
  WordSpan at;
};

/// A bracket or a scope that is open.
struct OpenGroup {
  bool bracket = false;
  std::size_t at = 0;      ///< of its first character, in bytes
  std::size_t first = 0;   ///< its first place
  std::size_t faults = 0;  ///< those before it
  std::vector<GroupPart> parts{};
  std::size_t non_manual = 0;  ///< the first of its own
  std::size_t non_manuals = 0;
  std::optional<Side> dominant{};
  SpaceOptions space{};
};

class UtteranceReader {
 public:
  UtteranceReader(std::string_view text, const UtteranceWords& words) : cursor_(text, words) {}
  UtteranceText read();

 private:
  Context context() const {
    if (groups_.empty()) return Context::text;
    return groups_.back().bracket ? Context::bracket : Context::scope;
  }
  std::vector<Place>& places() { return out_.utterance.places; }
  void read_word();
  void read_place(const Word& word);
  bool read_options_behind(std::size_t begin, PlaceRange range);
  void require_blank(char close);
  void read_syntax(std::size_t begin);
  bool begin_group(OpenGroup group);
  void begin_bracket(std::size_t begin);
  void begin_scope(std::size_t begin);
  void end_bracket();
  void end_scope();
  void read_parts();
  void read_group_part(OpenGroup& group);
  void add_part(std::size_t place, PlacePart part, WordSpan at);
  bool add_hold(HandHold hold, WordSpan at);
  void set_dominant(PlaceRange range, Side side);
  void take(Options options, PlaceRange range);
  void finish_groups();
  void sort();

  Cursor cursor_;
  UtteranceText out_;
  Milliseconds pause_{0};
  std::vector<OpenGroup> groups_;
  std::vector<OpenEnd> ends_;
  SpaceOfPlaces space_;
  std::vector<std::uint8_t> held_;  ///< [place] the hands that are held from it, one bit each
};

void UtteranceReader::add_part(std::size_t place, PlacePart part, WordSpan at) {
  std::vector<PlacePart>& parts = places()[place].parts;
  if (std::ranges::find(parts, part.part, &PlacePart::part) != parts.end()) {
    cursor_.report(repeated_part, at, fmt::format("'{}' is given twice; keep one", name_of(part.part)));
    return;
  }
  parts.push_back(std::move(part));
}

bool UtteranceReader::add_hold(HandHold hold, WordSpan at) {
  const std::size_t begin = hold.from + 1;  // 0: before the utterance
  static_assert(kPlaceBefore + 1 == 0);
  held_.resize(std::max(held_.size(), begin + 1));
  const auto hand = static_cast<std::uint8_t>(1U << static_cast<unsigned>(hold.hand));
  if ((held_[begin] & hand) != 0) {
    cursor_.report(repeated_part, at,
                   fmt::format("'{}' is held twice from the same place; keep one", name_of(hold.hand)));
    return false;
  }
  held_[begin] |= hand;
  out_.utterance.holds.push_back(hold);
  return true;
}

/// An inner choice of the dominant hand precedes.
void UtteranceReader::set_dominant(PlaceRange range, Side side) {
  for (std::size_t i = range.first; i <= range.last; ++i) {
    if (!places()[i].dominant) places()[i].dominant = side;
  }
}

void UtteranceReader::take(Options options, PlaceRange range) {
  for (PartOption& one : options.parts) {
    const std::size_t before = places()[range.first].parts.size();
    add_part(range.first, {.part = one.part, .signs = std::move(one.signs), .places = range.last - range.first + 1},
             one.at);
    if (one.extent && places()[range.first].parts.size() > before)
      ends_.push_back({OpenEnd::Of::part, std::move(*one.extent), range.last, range.first, before});
  }
  for (HoldOption& one : options.holds) {
    if (add_hold({.hand = one.hand, .from = range.last, .until = range.last}, one.at))
      ends_.push_back({OpenEnd::Of::hold, std::move(one.extent), range.last, 0, out_.utterance.holds.size() - 1});
  }
  for (NonManualOption& one : options.non_manuals) {
    one.non_manual.first = range.first;
    one.non_manual.last = range.last;
    out_.utterance.non_manuals.push_back(std::move(one.non_manual));
    if (one.extent)
      ends_.push_back(
          {OpenEnd::Of::non_manual, std::move(*one.extent), range.last, 0, out_.utterance.non_manuals.size() - 1});
  }
  if (options.dominant) set_dominant(range, *options.dominant);
  space_.take(std::move(options.space), range, out_.utterance, cursor_);
}

/// What closes something is followed by a blank, or by what closes something else.
void UtteranceReader::require_blank(char close) {
  if (cursor_.ends_word() || closes(cursor_.here(), context())) return;
  const std::size_t begin = cursor_.at;
  cursor_.at = cursor_.run_end(begin + 1, context());
  cursor_.report(stray_bracket, {begin, cursor_.at}, fmt::format("leave a blank behind '{}'", close),
                 ' ' + std::string(cursor_.text().substr(begin, cursor_.at - begin)));
}

/// Reads options, if there are some here, of what begins at `begin`. False if nothing closes them; goes back then.
bool UtteranceReader::read_options_behind(std::size_t begin, PlaceRange range) {
  if (cursor_.here() != '{') return true;
  const std::size_t open = cursor_.at;
  const std::size_t faults = cursor_.fault_count();
  ++cursor_.at;
  Options options = read_options(cursor_, OptionsOf::place);
  if (cursor_.stopped) return true;
  if (options.end == Options::End::broken) {
    cursor_.go_back(open, faults);
    cursor_.report_unquoted(open_bracket, begin, context(),
                            "the options behind '{' are not closed by '}'; close them, or quote the word if it is a "
                            "gloss");
    return false;
  }
  take(std::move(options), range);
  return true;
}

void UtteranceReader::read_place(const Word& word) {
  const std::size_t begin = word.at.begin;
  const bool options = cursor_.here() == '{';
  if (!options && !cursor_.ends_word() && !closes(cursor_.here(), context())) {
    return cursor_.report_unquoted(stray_bracket, begin, context(),
                                   "a bracket inside a word; quote the word if it is a gloss");
  }
  if (!word.literal && !groups_.empty() && word.text.front() == '@') {
    const std::string written(cursor_.text().substr(begin, word.at.end - begin));
    return cursor_.report(bad_sync, word.at, "a sync mark belongs behind the sign of a part; quote it if it is a gloss",
                          in_quotes(written));
  }
  SignReading reading = read_sign(word, cursor_.text());
  if (reading.fault) {
    cursor_.report(std::move(*reading.fault));
    if (options && !cursor_.skip_brackets()) cursor_.at = cursor_.run_end(cursor_.at + 1, context());
    return;
  }
  Place place;
  static_cast<SignRef&>(place) = std::move(reading.sign);
  if (!places().empty()) place.pause_before = pause_;
  places().push_back(std::move(place));
  const std::size_t index = places().size() - 1;
  if (options) {
    if (!read_options_behind(begin, {index, index})) {
      places().pop_back();
      return;
    }
    out_.spans.push_back({begin, cursor_.at});
    require_blank('}');
  } else {
    out_.spans.push_back(word.at);
  }
  pause_ = Milliseconds(0);
}

bool UtteranceReader::begin_group(OpenGroup group) {
  if (groups_.size() == kMostUtteranceDepth) {
    cursor_.report(too_deep, {group.at, group.at + 1},
                   fmt::format("more than {} brackets inside each other; use fewer", kMostUtteranceDepth));
    cursor_.stopped = true;
    return false;
  }
  groups_.push_back(std::move(group));
  return true;
}

void UtteranceReader::begin_bracket(std::size_t begin) {
  if (std::ranges::none_of(groups_, &OpenGroup::bracket)) {
    begin_group({.bracket = true, .at = begin, .first = places().size(), .faults = cursor_.fault_count()});
    return;
  }
  cursor_.at = begin;
  cursor_.report_unquoted(nested_bracket, begin, context(),
                          "a bracket inside a bracket; close the other one first, or quote the word if it is a gloss");
}

void UtteranceReader::begin_scope(std::size_t begin) {
  const std::size_t faults = cursor_.fault_count();
  Options options = read_options(cursor_, OptionsOf::scope);
  if (cursor_.stopped || options.end == Options::End::open_quote) return;
  if (options.end == Options::End::broken) {
    const bool closed = cursor_.here() == '}';
    cursor_.go_back(begin, faults);
    return cursor_.report_unquoted(closed ? empty_group : open_bracket, begin, context(),
                                   "a scope has options, a colon and places: {brows up: A B}; quote the word if it is "
                                   "a gloss");
  }
  OpenGroup group{.at = begin,
                  .first = places().size(),
                  .faults = faults,
                  .dominant = options.dominant,
                  .space = std::move(options.space)};
  std::vector<NonManual>& all = out_.utterance.non_manuals;
  group.non_manual = all.size();
  group.non_manuals = options.non_manuals.size();
  if (!begin_group(std::move(group))) return;
  for (NonManualOption& one : options.non_manuals) {
    one.non_manual.first = places().size();
    all.push_back(std::move(one.non_manual));
  }
}

void UtteranceReader::end_scope() {
  OpenGroup group = std::move(groups_.back());
  groups_.pop_back();
  std::vector<NonManual>& all = out_.utterance.non_manuals;
  if (places().size() == group.first) {
    all.resize(group.non_manual);
    if (cursor_.fault_count() == group.faults)
      cursor_.report(empty_group, {group.at, cursor_.at}, "a scope over nothing; put places between its colon and '}'");
  } else {
    const PlaceRange range{group.first, places().size() - 1};
    for (std::size_t i = 0; i < group.non_manuals; ++i) all[group.non_manual + i].last = range.last;
    if (group.dominant) set_dominant(range, *group.dominant);
    space_.take(std::move(group.space), range, out_.utterance, cursor_);
  }
  require_blank('}');
}

void UtteranceReader::end_bracket() {
  OpenGroup group = std::move(groups_.back());
  groups_.pop_back();
  const std::size_t count = places().size() - group.first;
  if (count == 0) {
    if (cursor_.fault_count() == group.faults) {
      cursor_.at = group.at;
      cursor_.report_unquoted(empty_group, group.at, context(),
                              "a bracket without a sign; put one behind '[', or quote the word if it is a gloss");
    }
    return;
  }
  const PlaceRange range{group.first, places().size() - 1};
  for (GroupPart& one : group.parts) {
    if (!one.hold) {
      add_part(range.first, {.part = one.part, .signs = std::move(one.signs), .places = count}, one.at);
    } else if (group.first > 0 || cursor_.words().follows) {
      const std::size_t before = group.first > 0 ? group.first - 1 : kPlaceBefore;
      add_hold({.hand = one.part, .from = before, .until = range.last}, one.at);
    } else if (cursor_.fault_count() == 0) {
      cursor_.report(nothing_to_hold, *one.hold,
                     "nothing to hold: no place is before it; begin with the sign to be held");
    }
  }
  if (read_options_behind(cursor_.at - 1, range)) require_blank(']');
}

void UtteranceReader::read_group_part(OpenGroup& group) {
  cursor_.skip_blanks();
  const std::string_view text = cursor_.text();
  const std::size_t begin = cursor_.at;
  while (!cursor_.ended() && std::string_view(":|]\"").find(cursor_.here()) == std::string_view::npos) ++cursor_.at;
  std::size_t end = cursor_.at;
  while (end > begin && is_blank(text[end - 1])) --end;
  const WordSpan at = begin < text.size() ? WordSpan{begin, std::max(end, begin + 1)} : WordSpan{begin - 1, begin};
  const std::string_view label = text.substr(begin, end - begin);
  const auto part = body_part_of(label);
  if (cursor_.here() != ':' || !part) {
    if (cursor_.here() == ':') {
      report_unknown_part(cursor_, at, label);
    } else {
      cursor_.report(unknown_part, at, "a part has a name, a colon and signs: weak: B");
    }
    return cursor_.skip_to(Context::bracket);
  }
  ++cursor_.at;
  PartReading reading = read_part(cursor_, Context::bracket);
  if (!reading.sound) return;
  if (std::ranges::find(group.parts, *part, &GroupPart::part) != group.parts.end()) {
    cursor_.report(repeated_part, at, fmt::format("'{}' is given twice; keep one", name_of(*part)));
  } else if (reading.hold && !is_hand(*part)) {
    cursor_.report(bad_option, {begin, reading.hold->end},
                   fmt::format("'{}' cannot be held; a hand can: dominant, weak, right or left", name_of(*part)));
  } else if (check_rest(cursor_, reading, *part, begin)) {
    group.parts.push_back({*part, std::move(reading.signs), reading.hold, at});
  }
}

/// Reads the parts of a bracket from behind the first `|` to behind the `]`.
void UtteranceReader::read_parts() {
  for (;;) {
    read_group_part(groups_.back());
    if (cursor_.stopped || cursor_.ended()) return;
    const char close = cursor_.here();
    ++cursor_.at;
    if (close == ']') return end_bracket();
  }
}

/// Reads the bracket or `|` at `begin`; the cursor is behind it.
void UtteranceReader::read_syntax(std::size_t begin) {
  const char c = cursor_.text()[begin];
  if (c == '[') return begin_bracket(begin);
  if (c == '{') return begin_scope(begin);
  if (context() == Context::bracket && c == '|') return read_parts();
  if (context() == Context::bracket && c == ']') return end_bracket();
  if (context() == Context::scope && c == '}') return end_scope();
  cursor_.report_unquoted(stray_bracket, begin, context(),
                          fmt::format("'{}' closes nothing here; quote the word if it is a gloss", c));
}

void UtteranceReader::read_word() {
  const std::size_t begin = cursor_.at;
  const Word word = cursor_.word(context());
  const char c = cursor_.text()[begin];
  const bool bracket = c == '[' || c == ']' || c == '{' || c == '}' || (c == '|' && context() == Context::bracket);
  if (bracket && !word.literal) {
    read_syntax(begin);
  } else if (word.is_pause() && (cursor_.ends_word() || closes(cursor_.here(), context()))) {
    pause_ = std::max(pause_, word.text == "," ? kComma : kFullStop);
  } else {
    read_place(word);
  }
}

/// Reports the brackets that are still open; the utterance keeps what is in them.
void UtteranceReader::finish_groups() {
  for (const OpenGroup& group : groups_) {
    for (std::size_t i = 0; i < group.non_manuals; ++i) {
      NonManual& one = out_.utterance.non_manuals[group.non_manual + i];
      one.last = places().size() > one.first ? places().size() - 1 : kNoPlace;
    }
    if (cursor_.fault_count() > group.faults) continue;
    const std::size_t end = cursor_.run_end(group.at, Context::text);
    const std::string_view run = cursor_.text().substr(group.at, end - group.at);
    const bool gloss = group.bracket && group.parts.empty() && run.size() > 1;
    cursor_.report(
        open_bracket, {group.at, end},
        fmt::format("'{}' is opened here and never closed; close it, or quote the word if it is a gloss", run.front()),
        gloss ? in_quotes(run) : std::string());
  }
}

void UtteranceReader::sort() {
  std::ranges::stable_sort(out_.utterance.holds, {}, [](const HandHold& one) { return one.from + 1; });
  std::ranges::stable_sort(out_.utterance.non_manuals, [](const NonManual& a, const NonManual& b) {
    return a.first != b.first ? a.first < b.first : a.last > b.last;
  });
  std::ranges::stable_sort(cursor_.faults(), {}, [](const UtteranceFault& fault) { return fault.at.begin; });
}

UtteranceText UtteranceReader::read() {
  if (cursor_.text().size() > kMostBytes) {
    out_.faults.push_back({too_long, {0, cursor_.text().size()}, "longer than 1,000,000 bytes", {}});
    return std::move(out_);
  }
  for (cursor_.skip_blanks(); !cursor_.ended() && !cursor_.stopped; cursor_.skip_blanks()) read_word();
  finish_groups();
  const bool sound = cursor_.fault_count() == 0;
  finish_ends(out_.utterance, ends_, cursor_);
  space_.finish(out_.utterance, cursor_, sound);
  sort();
  out_.pause_after = pause_;
  out_.faults = std::move(cursor_.faults());
  return std::move(out_);
}

}  // namespace

UtteranceText read_utterance(std::string_view text, const UtteranceWords& words) {
  return UtteranceReader(text, words).read();
}

}  // namespace signweave
