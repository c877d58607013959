#include "demo/mouthing.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "signweave/core/text.h"

namespace signweave::demo {
namespace {

struct Rule {
  std::string_view letters;
  MouthShape shape;
};

constexpr MouthShape kOpen{.jaw = 0.58f, .wide = 0.08f, .length = 1.5f};
constexpr MouthShape kWide{.jaw = 0.26f, .wide = 0.40f, .length = 1.5f};
constexpr MouthShape kNarrow{.jaw = 0.12f, .wide = 0.60f, .length = 1.4f};
constexpr MouthShape kRound{.jaw = 0.34f, .funnel = 0.70f, .pucker = 0.15f, .length = 1.5f};
constexpr MouthShape kPursed{.jaw = 0.08f, .funnel = 0.10f, .pucker = 0.85f, .length = 1.4f};
constexpr MouthShape kShut{.close = 0.15f, .press = 0.95f, .length = 1.2f};
constexpr MouthShape kLip{.jaw = 0.06f, .funnel = 0.10f, .press = 0.35f};
constexpr MouthShape kTeeth{.jaw = 0.08f, .wide = 0.30f};
constexpr MouthShape kTongue{.jaw = 0.18f, .wide = 0.08f};
constexpr MouthShape kBehind{.jaw = 0.20f};
constexpr MouthShape kHush{.jaw = 0.12f, .funnel = 0.55f, .pucker = 0.25f};

/// The longest that fits applies; those without a row are silent.
constexpr Rule kRules[] = {
    {"eau", kRound}, {"eil", kWide},  {"oir", kOpen}, {"ain", kWide}, {"au", kRound},  {"ou", kPursed}, {"où", kPursed},
    {"oi", kOpen},   {"on", kRound},  {"om", kRound}, {"an", kOpen},  {"am", kOpen},   {"en", kOpen},   {"em", kOpen},
    {"in", kWide},   {"eu", kPursed}, {"ei", kWide},  {"ai", kWide},  {"qu", kBehind}, {"ch", kHush},   {"gn", kTongue},
    {"a", kOpen},    {"à", kOpen},    {"e", kWide},   {"é", kWide},   {"è", kWide},    {"ê", kWide},    {"i", kNarrow},
    {"y", kNarrow},  {"o", kRound},   {"ô", kRound},  {"u", kPursed}, {"û", kPursed},  {"p", kShut},    {"b", kShut},
    {"m", kShut},    {"f", kLip},     {"v", kLip},    {"s", kTeeth},  {"z", kTeeth},   {"c", kTeeth},   {"ç", kTeeth},
    {"t", kTongue},  {"d", kTongue},  {"n", kTongue}, {"l", kTongue}, {"r", kBehind},  {"g", kBehind},  {"k", kBehind},
    {"j", kHush},
};

bool is_nasal(std::string_view letters) {
  return letters.size() == 2 && (letters[1] == 'n' || letters[1] == 'm');
}

bool is_vowel(char c) {
  return std::string_view("aeiouy").find(c) != std::string_view::npos || static_cast<unsigned char>(c) >= 0x80;
}

const Rule* rule_at(std::string_view rest) {
  const Rule* best = nullptr;
  for (const Rule& rule : kRules) {
    if (!rest.starts_with(rule.letters)) continue;
    // "an" before a vowel or a second n is a, then n.
    const char after = rest.size() > rule.letters.size() ? rest[rule.letters.size()] : ' ';
    if (is_nasal(rule.letters) && (is_vowel(after) || after == 'n' || after == 'm')) continue;
    if (best == nullptr || rule.letters.size() > best->letters.size()) best = &rule;
  }
  return best;
}

/// A word without the letters that are silent at its end.
std::string_view spoken(std::string_view word) {
  const auto drop = [&](std::string_view letters) {
    if (word.size() > 2 && letters.find(word.back()) != std::string_view::npos) word.remove_suffix(1);
  };
  drop("stdxz");
  drop("e");
  return word;
}

}  // namespace

std::vector<MouthShape> mouth_shapes(std::string_view word) {
  std::vector<MouthShape> shapes;
  const std::string folded = fold_case(word);
  std::string_view text = folded;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    std::string_view rest = spoken(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    char before = ' ';
    while (!rest.empty()) {
      const Rule* rule = rule_at(rest);
      const std::size_t size = rule == nullptr ? 1 : rule->letters.size();
      const bool twice = size == 1 && rest[0] == before;  // a doubled letter
      if (rule != nullptr && !twice) shapes.push_back(rule->shape);
      if (rule != nullptr && rule->letters.starts_with("oi")) shapes.insert(shapes.end() - 1, kPursed);
      before = rest[0];
      rest.remove_prefix(size);
    }
  }
  return shapes;
}

}  // namespace signweave::demo
