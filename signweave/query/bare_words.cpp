#include "signweave/query/bare_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <tuple>
#include <unordered_set>

#include "signweave/core/text.h"
#include "signweave/query/vocabulary.h"

namespace signweave {
namespace {

constexpr std::size_t kMostWords = 64;         // the maximum number of places of a sequence
constexpr std::size_t kMostFound = 5'000'000;  // as for any query
constexpr std::size_t kMostWordHints = 8;

/// Opening and closing quotation marks.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kQuotationMarks = {
    {{"\"", "\""}, {"\xE2\x80\x9C", "\xE2\x80\x9D"}, {"\xC2\xAB", "\xC2\xBB"}, {"\xE2\x80\x9E", "\xE2\x80\x9C"}}};
constexpr std::array<std::string_view, 9> kSeparators = {
    " ", "\t", "\r", "\n", ",", ";", "\xC2\xA0", "\xE2\x80\xAF", "\xE3\x80\x80"};  // including no-break and wide blanks

template <typename Texts>
std::size_t begins_with_any(std::string_view text, const Texts& texts) {
  const auto at = std::ranges::find_if(texts, [&](std::string_view one) { return text.starts_with(one); });
  return at == texts.end() ? 0 : at->size();
}

using Fits = std::function<bool(std::string_view label)>;

class Finder {
 public:
  Finder(const Segments& segments, const FindLimits& limits)
      : segments_(segments), limits_(limits), stop_check_(limits) {}

  void rows_of(RowKind kind, WordMatch match, const Fits& fits) {
    for (const Segments::Member& member : segments_.members()) {
      for (const std::uint32_t label : member.table.labels_of(kind)) {
        stop_check_.tick();
        const std::string_view text = member.table.text_at(label);
        if (text.empty() || !fits(text)) continue;
        for (const RowId row : member.table.with_label(kind, label)) {
          stop_check_.tick();
          if (member.numbers[member.table.recording(row)] != Segments::kNone) add(row + member.first, match);
        }
      }
    }
  }
  void sequences(const std::vector<std::vector<std::string>>& glosses) {
    PhaseQuery query;
    for (const std::vector<std::string>& of_word : glosses) {
      if (of_word.empty()) return;
      Expression any{.kind = Expression::Kind::any, .condition = {}, .operands = {}, .sequence = {}};
      for (const std::string& gloss : of_word) any.operands.push_back(has_gloss(gloss));
      query.elements.push_back({.term = {any.operands.size() == 1 ? any.operands.front() : any}, .relations = {}});
    }
    query.gaps.resize(query.elements.size() - 1);
    for (Segment& segment : find(query, segments_, limits_)) {
      answers_.push_back({std::move(segment), WordMatch::sequence});
    }
  }
  bool empty() const noexcept { return answers_.empty(); }

  std::vector<WordAnswer> take() {
    std::ranges::stable_sort(answers_, [](const WordAnswer& a, const WordAnswer& b) {
      const auto key = [](const WordAnswer& one) {
        return std::tie(one.match, one.segment.recording, one.segment.span.begin, one.segment.span.end,
                        one.segment.row);
      };
      return key(a) < key(b);
    });
    if (limits_.limit && answers_.size() > *limits_.limit) answers_.resize(*limits_.limit);
    return std::move(answers_);
  }

 private:
  static Expression has_gloss(const std::string& gloss) {
    Expression result;
    result.condition.field = Field::gloss;
    result.condition.value = gloss;
    return result;
  }
  void add(RowId row, WordMatch match) {
    if (!seen_.insert(row).second) return;
    if (answers_.size() == kMostFound) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("query: more than {} answers; narrow it, or give a limit", kMostFound));
    }
    Segment segment;
    segment.recording = segments_.recording_name(segments_.recording(row));
    segment.tier = segments_.tier(row);
    segment.name = segments_.label(row);
    segment.span = segments_.span(row);
    segment.row = row;
    answers_.push_back({std::move(segment), match});
  }

  const Segments& segments_;
  const FindLimits& limits_;
  StopCheck stop_check_;
  std::unordered_set<RowId> seen_;
  std::vector<WordAnswer> answers_;
};

/// Whether `words` occur in a label from the beginning of one of its own words; both in loose form.
bool stands_in(std::string_view words, std::string_view label) {
  const auto is_inside = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || (c & 0x80) != 0; };
  for (std::size_t at = label.find(words); at != label.npos; at = label.find(words, at + 1)) {
    if (at == 0 || !is_inside(label[at - 1])) return true;
  }
  return false;
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

}  // namespace

std::string_view word_of(WordMatch match) noexcept {
  constexpr std::array<std::string_view, 6> kNames = {"exact", "folded", "sequence", "part", "label", "some"};
  return kNames[static_cast<std::size_t>(match)];
}

std::optional<std::vector<std::string>> bare_words(std::string_view text) {
  std::vector<std::string> words;
  bool inside = false;
  const auto word = [&]() -> std::string& {
    if (!inside) words.emplace_back();
    inside = true;
    return words.back();
  };
  while (!text.empty()) {
    if (const std::size_t blank = begins_with_any(text, kSeparators)) {
      text.remove_prefix(blank);
      inside = false;
      continue;
    }
    const auto quote =
        std::ranges::find_if(kQuotationMarks, [&](const auto& one) { return text.starts_with(one.first); });
    if (!inside && quote != kQuotationMarks.end()) {
      text.remove_prefix(quote->first.size());
      while (!text.starts_with(quote->second)) {
        if (text.size() > 1 && text[0] == '\\' && (text[1] == '"' || text[1] == '\\')) text.remove_prefix(1);
        if (text.empty()) return std::nullopt;
        word() += text[0];
        text.remove_prefix(1);
      }
      text.remove_prefix(quote->second.size());
      inside = false;
      continue;
    }
    const bool is_operator = std::string_view("()[]&|=<>").find(text[0]) != std::string_view::npos;
    const bool begins = !inside && std::string_view("!@$/~").find(text[0]) != std::string_view::npos;
    if (is_operator || begins) return std::nullopt;
    word() += text[0];
    text.remove_prefix(1);
  }
  std::erase_if(words, [](const std::string& one) { return trimmed(one).empty(); });
  if (words.empty() || words.size() > kMostWords) return std::nullopt;
  return words;
}

std::vector<WordAnswer> find_words(const std::vector<std::string>& words, const Segments& segments,
                                   const FindLimits& limits) {
  const std::string exact = match_form(joined(words));
  const std::string loose = loose_form(exact);
  if (loose.empty()) return {};
  Finder finder(segments, limits);
  finder.rows_of(RowKind::sign, WordMatch::exact, [&](std::string_view label) { return label == exact; });
  finder.rows_of(RowKind::sign, WordMatch::folded, [&](std::string_view label) { return loose_form(label) == loose; });
  std::vector<std::vector<std::string>> glosses(words.size());  // glosses that match each word
  if (words.size() > 1) {
    const std::vector<std::string> known = segments.glosses();
    for (const std::string& gloss : known) {
      const std::string form = loose_form(gloss);
      for (std::size_t i = 0; i < words.size(); ++i) {
        if (form == loose_form(words[i])) glosses[i].push_back(gloss);
      }
    }
    finder.sequences(glosses);
  }
  const auto part = [&](std::string_view label) { return stands_in(loose, loose_form(label)); };
  finder.rows_of(RowKind::sign, WordMatch::part, part);
  finder.rows_of(RowKind::annotation, WordMatch::label, part);
  if (finder.empty() && words.size() > 1) {
    finder.rows_of(RowKind::sign, WordMatch::some, [&](std::string_view label) {
      return std::ranges::any_of(glosses, [&](const auto& one) { return std::ranges::find(one, label) != one.end(); });
    });
  }
  return finder.take();
}

std::vector<Notice> word_hints(const std::vector<std::string>& words, const Segments& segments) {
  std::vector<Notice> hints;
  std::vector<std::string> glosses = segments.glosses();
  std::unordered_set<std::string> forms;  // one of several glosses that differ only in spelling is enough
  std::erase_if(glosses, [&](const std::string& gloss) { return !forms.insert(loose_form(gloss)).second; });
  const LanguageWords language = language_words();
  const auto is = [](std::span<const std::string> known, const std::string& word) -> const std::string* {
    const std::string form = loose_form(word);
    const auto at = std::ranges::find_if(known, [&](const std::string& one) { return loose_form(one) == form; });
    return at == known.end() ? nullptr : &*at;
  };
  const std::vector<std::string> recordings = segments.recordings();
  for (const std::string& word : words) {
    if (hints.size() == kMostWordHints || is(glosses, word) != nullptr) continue;
    std::string text = fmt::format("nothing is called \"{}\"", printable(word));
    if (const std::string* recording = is(recordings, word)) {
      text += fmt::format("; it is a recording: did you mean recording = \"{}\"?", *recording);
    } else if (const std::string* phase = is(language.phases, word)) {
      text += fmt::format("; did you mean phase = {}?", *phase);
    } else if (const std::string* field = is(language.fields, word)) {
      text += fmt::format("; {} is a condition: see docs/query.md for its syntax", *field);
    } else {
      text += did_you_mean(word, glosses);
    }
    hints.push_back({"query", text});
  }
  return hints;
}

bool is_loosely_a_gloss(std::string_view text, const Segments& segments) {
  const std::string form = loose_form(text);
  for (const Segments::Member& member : segments.members()) {
    for (const std::uint32_t label : member.table.labels_of(RowKind::sign)) {
      if (loose_form(member.table.text_at(label)) == form) return true;
    }
  }
  return false;
}

}  // namespace signweave
