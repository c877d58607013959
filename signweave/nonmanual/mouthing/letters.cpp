#include "signweave/nonmanual/mouthing/letters.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <string_view>

#include "signweave/core/text.h"
#include "signweave/nonmanual/mouthing/code_points.h"

namespace signweave {
namespace {

using namespace std::string_view_literals;

/// One element of a context.
struct Element {
  enum class Kind { edge, vowel, consonant, consonants, one_of };
  Kind kind = Kind::edge;
  std::u32string letters;  ///< for one_of
};

struct LetterRule {
  std::vector<Element> before;  ///< nearest first
  std::u32string letters;
  std::vector<Element> after;
  std::string ipa;
};
using LetterRules = std::map<char32_t, std::vector<LetterRule>>;  ///< [first letter], in order

constexpr std::u32string_view kVowels = U"aeiouyàâäáãåæéèêëíìîïóòôöõøœúùûüÿý";

bool is_vowel_letter(char32_t letter) noexcept {
  return kVowels.find(letter) != kVowels.npos;
}

std::vector<Element> context_of(std::u32string_view text) {
  std::vector<Element> elements;
  for (std::size_t i = 0; i < text.size(); ++i) {
    switch (text[i]) {
      case U'_':
        elements.push_back({Element::Kind::edge, {}});
        break;
      case U'#':
        elements.push_back({Element::Kind::vowel, {}});
        break;
      case U'^':
        elements.push_back({Element::Kind::consonant, {}});
        break;
      case U':':
        elements.push_back({Element::Kind::consonants, {}});
        break;
      case U'{': {
        const std::size_t end = text.find(U'}', i);
        elements.push_back({Element::Kind::one_of, std::u32string(text.substr(i + 1, end - i - 1))});
        i = end;
        break;
      }
      default:
        elements.push_back({Element::Kind::one_of, std::u32string(1, text[i])});
    }
  }
  return elements;
}

LetterRules parsed(std::span<const std::string_view> texts) {
  LetterRules rules;
  for (const std::string_view text : texts) {
    const std::size_t open = text.find('[');
    const std::size_t close = text.find(']');
    const std::size_t equals = text.find('=', close);
    assert(open < close && close < equals && equals != text.npos);
    LetterRule rule{.before = context_of(code_points(text.substr(0, open))),
                    .letters = code_points(text.substr(open + 1, close - open - 1)),
                    .after = context_of(code_points(text.substr(close + 1, equals - close - 1))),
                    .ipa = std::string(text.substr(equals + 1))};
    std::ranges::reverse(rule.before);
    rules[rule.letters.front()].push_back(std::move(rule));
  }
  return rules;
}

const LetterRules& rules_of(MouthingLanguage language) {
  static const LetterRules fr = parsed(letter_rules_fr());
  static const LetterRules en = parsed(letter_rules_en());
  static const LetterRules de = parsed(letter_rules_de());
  static const LetterRules nl = parsed(letter_rules_nl());
  switch (language) {
    case MouthingLanguage::fr:
      return fr;
    case MouthingLanguage::en:
      return en;
    case MouthingLanguage::de:
      return de;
    case MouthingLanguage::nl:
      return nl;
  }
  return fr;
}

/// True if a context matches the letters of a word from `at` on, in the direction `step`.
bool matches(const std::vector<Element>& context, std::u32string_view word, std::ptrdiff_t at, std::ptrdiff_t step) {
  const auto inside = [&] { return at >= 0 && at < static_cast<std::ptrdiff_t>(word.size()); };
  const auto letter = [&] { return word[static_cast<std::size_t>(at)]; };
  for (const Element& element : context) {
    switch (element.kind) {
      case Element::Kind::edge:
        if (inside()) return false;
        continue;
      case Element::Kind::consonants:
        while (inside() && !is_vowel_letter(letter())) at += step;
        continue;
      case Element::Kind::vowel:
        if (!inside() || !is_vowel_letter(letter())) return false;
        break;
      case Element::Kind::consonant:
        if (!inside() || is_vowel_letter(letter())) return false;
        break;
      case Element::Kind::one_of:
        if (!inside() || element.letters.find(letter()) == element.letters.npos) return false;
        break;
    }
    at += step;
  }
  return true;
}

const LetterRule* rule_at(const LetterRules& rules, std::u32string_view word, std::size_t at) {
  const auto found = rules.find(word[at]);
  if (found == rules.end()) return nullptr;
  for (const LetterRule& rule : found->second) {
    if (word.substr(at, rule.letters.size()) != rule.letters) continue;
    const auto begin = static_cast<std::ptrdiff_t>(at);
    const auto end = begin + static_cast<std::ptrdiff_t>(rule.letters.size());
    if (matches(rule.before, word, begin - 1, -1) && matches(rule.after, word, end, 1)) return &rule;
  }
  return nullptr;
}

bool is_apostrophe(char32_t letter) noexcept {
  return letter == U'\'' || letter == 0x2019 || letter == 0x02bc;
}

/// Characters between words that need no notice.
bool is_separator(char32_t letter) noexcept {
  return letter <= U' ' ||
         (letter < 0x80 && U"0123456789"sv.find(letter) == std::u32string_view::npos &&
          !(letter >= U'a' && letter <= U'z')) ||
         (letter >= 0xa0 && letter <= 0xbf) || (letter >= 0x2000 && letter <= 0x206f);
}

/// The words of a text in lower case, with letters that the language lacks replaced by those without their accents.
class WordReader {
 public:
  WordReader(const LetterRules& rules, LetterReading& reading) : rules_(rules), reading_(reading) {}

  void read(std::u32string_view text) {
    for (const char32_t letter : text) {
      if (is_apostrophe(letter)) continue;
      if (is_separator(letter)) {
        end_word();
      } else {
        add(letter);
      }
    }
    end_word();
  }

 private:
  void add(char32_t letter) {
    if (rules_.contains(letter)) {
      word_.push_back(letter);
      return;
    }
    const std::string bare = loose_form(utf8_of(letter));
    const std::u32string letters = code_points(bare);
    if (!letters.empty() && std::ranges::all_of(letters, [&](char32_t one) { return rules_.contains(one); })) {
      word_ += letters;
    } else if (const std::string shown = utf8_of(letter);
               std::ranges::find(reading_.skipped, shown) == reading_.skipped.end()) {
      reading_.skipped.push_back(shown);
    }
  }

  void end_word() {
    std::string ipa;
    for (std::size_t at = 0; at < word_.size();) {
      const LetterRule* rule = rule_at(rules_, word_, at);
      if (rule != nullptr) ipa += rule->ipa;
      at += rule != nullptr ? rule->letters.size() : 1;
    }
    word_.clear();
    if (ipa.empty()) return;
    if (!reading_.ipa.empty()) reading_.ipa += ' ';
    reading_.ipa += ipa;
  }

  const LetterRules& rules_;
  LetterReading& reading_;
  std::u32string word_;
};

}  // namespace

std::string_view name_of(MouthingLanguage language) noexcept {
  switch (language) {
    case MouthingLanguage::fr:
      return "fr";
    case MouthingLanguage::en:
      return "en";
    case MouthingLanguage::de:
      return "de";
    case MouthingLanguage::nl:
      return "nl";
  }
  return "fr";
}

std::optional<MouthingLanguage> mouthing_language(std::string_view name) noexcept {
  for (const MouthingLanguage language : kMouthingLanguages) {
    if (name_of(language) == name) return language;
  }
  return std::nullopt;
}

LetterReading read_letters(std::string_view text, MouthingLanguage language) {
  LetterReading reading;
  if (!is_utf8(text)) return reading;
  WordReader(rules_of(language), reading).read(code_points(fold_case(text)));
  return reading;
}

}  // namespace signweave
