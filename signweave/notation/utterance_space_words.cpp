#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "signweave/notation/utterance_space.h"

namespace signweave::utterances {
namespace {

const std::array<SpaceWord, 7> kWords = {{
    {"big", SpaceValue::size, {.size = kBig}},
    {"small", SpaceValue::size, {.size = kSmall}},
    {"slow", SpaceValue::speed, {.speed = kSlow}},
    {"fast", SpaceValue::speed, {.speed = kFast}},
    {"plural", SpaceValue::repeat, {.repetitions = kPluralRepetitions, .outward = true}},
    {"mirrored", SpaceValue::mirrored, {.mirrored = true}},
    {"unturned", SpaceValue::unturned, {.keeps_turn = true}},
}};
constexpr std::array<SpaceNumbers, 7> kNumbers = {{
    {"move", SpaceValue::move, "a move has three numbers, cm to the left/up/forward: move 10/0/-5"},
    {"turn", SpaceValue::turn, "a turn has three numbers, degrees about the axes left/up/forward: turn 0/30/0"},
    {"scale", SpaceValue::scale, "a scale has one number, or three for left/up/forward: scale 1.2 or scale 1/1.5/1"},
    {"size", SpaceValue::size, "a size is one number: size 1.3"},
    {"speed", SpaceValue::speed, "a speed is one number: speed 0.8"},
    {"repeat", SpaceValue::repeat, "'repeat' is followed by a whole number: repeat 3"},
    {"plural", SpaceValue::repeat, "'plural' is alone, or followed by a whole number: plural 4"},
}};

/// One to three numbers separated by "/"; empty for anything else.
std::vector<float> numbers_of(std::string_view text) {
  std::vector<float> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('/', begin), text.size());
    if (begin < end && text[begin] == '+') ++begin;
    float value = 0;
    const auto [stop, fault] = std::from_chars(text.data() + begin, text.data() + end, value);
    if (fault != std::errc() || stop != text.data() + end || !std::isfinite(value) || numbers.size() == 3) return {};
    numbers.push_back(value == 0 ? 0 : value);  // no negative zero
    begin = end + 1;
  }
  return numbers;
}

std::string axes_text(const std::array<float, 3>& axes) {
  return fmt::format("{}/{}/{}", axes[0], axes[1], axes[2]);
}

}  // namespace

std::string_view name_of(SpaceValue value) noexcept {
  constexpr std::array<std::string_view, kSpaceValues.size()> kNames = {
      "from", "to", "at", "along", "past", "unturned", "move", "turn", "scale", "size", "speed", "repeat", "mirrored"};
  return kNames[static_cast<std::size_t>(value)];
}

const SpaceWord* find_space_word(std::string_view word) noexcept {
  const auto at = std::ranges::find(kWords, word, &SpaceWord::word);
  return at == kWords.end() ? nullptr : &*at;
}

const SpaceNumbers* find_space_numbers(std::string_view word, std::string_view numbers) noexcept {
  if (numbers.empty()) return nullptr;
  const char first = numbers.front();
  const bool sign = first == '+' || first == '-';
  if (!(first == '.' || (first >= '0' && first <= '9') || (sign && numbers.find('/') != numbers.npos))) return nullptr;
  const auto at = std::ranges::find(kNumbers, word, &SpaceNumbers::word);
  return at == kNumbers.end() ? nullptr : &*at;
}

std::optional<SpaceChange> change_of(const SpaceNumbers& word, std::string_view text) {
  SpaceChange change;
  if (word.value == SpaceValue::repeat) {
    const auto count = whole_number(text);
    if (!count) return std::nullopt;
    change.repetitions = *count;
    change.outward = word.word == "plural";
    return change;
  }
  const std::vector<float> numbers = numbers_of(text);
  const bool may_be_three = word.value != SpaceValue::size && word.value != SpaceValue::speed;
  const bool may_be_one = !may_be_three || word.value == SpaceValue::scale;
  if (!(numbers.size() == 3 && may_be_three) && !(numbers.size() == 1 && may_be_one)) return std::nullopt;
  const std::array<float, 3> axes = {numbers.front(), numbers[numbers.size() / 2], numbers.back()};
  if (word.value == SpaceValue::move) change.move = axes;
  if (word.value == SpaceValue::turn) change.turn = axes;
  if (word.value == SpaceValue::scale) change.scale = axes;
  if (word.value == SpaceValue::size) change.size = numbers.front();
  if (word.value == SpaceValue::speed) change.speed = numbers.front();
  return change;
}

bool is_space_option(std::string_view name) noexcept {
  const std::size_t blank = name.find(' ');
  if (blank == name.npos) return find_space_word(name) != nullptr;
  return name.find(' ', blank + 1) == name.npos &&
         find_space_numbers(name.substr(0, blank), name.substr(blank + 1)) != nullptr;
}

// Words such as "slow" are not written: an expression may have such a name.
std::vector<std::string> space_texts(const SpaceChange& change) {
  std::vector<std::string> texts;
  const auto locus = [](std::string_view word, const LocusRef& is) {
    return fmt::format("{} @{}", word, to_string(is));
  };
  if (change.from && change.to) {
    texts.push_back(locus("from", *change.from) + ' ' + locus("to", *change.to));
  } else if (change.from || change.to) {
    texts.push_back(change.from ? locus("from", *change.from) : locus("to", *change.to));
  }
  if (change.at) texts.push_back(locus("at", *change.at));
  if (!change.along.empty()) {
    std::string& text = texts.emplace_back("along");
    for (const LocusRef& one : change.along) text += " @" + to_string(one);
  }
  if (change.past) texts.push_back(locus("past", *change.past));
  if (change.keeps_turn) texts.emplace_back("unturned");
  const SpaceChange none;
  if (change.move != none.move) texts.push_back("move " + axes_text(change.move));
  if (change.turn != none.turn) texts.push_back("turn " + axes_text(change.turn));
  if (change.scale != none.scale) {
    const bool same = change.scale[0] == change.scale[1] && change.scale[1] == change.scale[2];
    texts.push_back("scale " + (same ? fmt::format("{}", change.scale[0]) : axes_text(change.scale)));
  }
  if (change.size != none.size) texts.push_back(fmt::format("size {}", change.size));
  if (change.speed != none.speed) texts.push_back(fmt::format("speed {}", change.speed));
  if (change.outward) {
    texts.push_back(fmt::format("plural {}", change.repetitions));
  } else if (change.repetitions != none.repetitions) {
    texts.push_back(fmt::format("repeat {}", change.repetitions));
  }
  if (change.mirrored) texts.emplace_back("mirrored");
  return texts;
}

std::string setup_text(const LocusSetup& setup) {
  return fmt::format("@{} = @{}", setup.name, to_string(setup.is));
}

}  // namespace signweave::utterances
