#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace signweave {

/// The languages whose words can be mouthed.
enum class MouthingLanguage { fr, en, de, nl };
inline constexpr MouthingLanguage kMouthingLanguages[] = {MouthingLanguage::fr, MouthingLanguage::en,
                                                          MouthingLanguage::de, MouthingLanguage::nl};
std::string_view name_of(MouthingLanguage language) noexcept;  ///< "fr", …
std::optional<MouthingLanguage> mouthing_language(std::string_view name) noexcept;

/// A pronunciation by letter rules.
struct LetterReading {
  std::string ipa;                   ///< words separated by blanks
  std::vector<std::string> skipped;  ///< characters without a rule, each once: digits, other scripts
};

/// Reads words by the rules of a language: good enough for what the mouth shows, not for what is heard. `text` is UTF-8
/// of any normal form. Punctuation separates words, an apostrophe does not.
LetterReading read_letters(std::string_view text, MouthingLanguage language);

/// The rules of a language, most special first for each letter. A rule is BEFORE[LETTERS]AFTER=IPA: the letters are
/// pronounced so between these contexts. In a context, _ is the word's edge, # a vowel letter, ^ a consonant letter,
/// : any number of consonant letters, {abc} one of these, and anything else itself. Inside this module only.
std::span<const std::string_view> letter_rules_fr() noexcept;
std::span<const std::string_view> letter_rules_en() noexcept;
std::span<const std::string_view> letter_rules_de() noexcept;
std::span<const std::string_view> letter_rules_nl() noexcept;

}  // namespace signweave
