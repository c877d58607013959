#include "signweave/nonmanual/mouthing/phone.h"

#include <algorithm>
#include <optional>

#include "signweave/core/text.h"
#include "signweave/nonmanual/mouthing/code_points.h"

namespace signweave {
namespace {

constexpr float kLongVowel = 1.4f;
constexpr float kGlide = 0.6f;
constexpr float kWeak = 0.7f;  // of ə

struct IpaRow {
  std::u32string_view letters;
  Viseme viseme;
};
constexpr IpaRow kIpa[] = {
    {U"pbmɓ", Viseme::pp},          {U"fvʋɱɸβ", Viseme::ff}, {U"θð", Viseme::th},     {U"tdʈɖ", Viseme::dd},
    {U"kɡgxɣʁʀχqcɟçʝ", Viseme::kk}, {U"ʃʒɕʑʂʐ", Viseme::ch}, {U"sz", Viseme::ss},     {U"nlɲŋɫʎɴ", Viseme::nn},
    {U"ɹrɾɻɽ", Viseme::rr},         {U"aɑæʌɐ", Viseme::aa},  {U"eɛəɜɘɚɝ", Viseme::e}, {U"iɪjɨ", Viseme::i},
    {U"oɔɒɤ", Viseme::o},           {U"uʊwɯ", Viseme::u},    {U"yʏɥʉ", Viseme::y},    {U"øœɵɞɶ", Viseme::oe},
};

std::optional<Viseme> viseme_of(char32_t letter) noexcept {
  for (const IpaRow& row : kIpa) {
    if (row.letters.find(letter) != row.letters.npos) return row.viseme;
  }
  return std::nullopt;
}

bool is_semivowel(char32_t letter) noexcept {
  return letter == U'j' || letter == U'w' || letter == U'ɥ';
}

/// Reads IPA letter by letter.
class IpaReader {
 public:
  std::vector<Phone> read(std::u32string_view ipa) {
    bool skipped = false;  // in a language's name
    for (const char32_t letter : ipa) {
      if (letter == U'(') skipped = true;
      if (!skipped) take(letter);
      if (letter == U')') skipped = false;
    }
    return std::move(phones_);
  }

 private:
  void take(char32_t letter) {
    if (letter == U' ' || letter == U'\n' || letter == U'\t' || letter == U'\r' || letter == U'_') {
      word_begin_ = true;
      last_ = 0;
      return;
    }
    if (letter == 0x200d || letter == 0x0361) {  // ties
      tied_ = true;
      return;
    }
    if (letter == 0x02d0 && !phones_.empty() && is_vowel(phones_.back().viseme)) phones_.back().length *= kLongVowel;
    if (letter == 0x032f && !phones_.empty()) make_glide(phones_.back());
    const std::optional<Viseme> viseme = viseme_of(letter);
    if (!viseme) return;
    // tʃ and dʒ are one sound for the eye.
    if (*viseme == Viseme::ch && (last_ == U't' || last_ == U'd')) {
      phones_.back().viseme = Viseme::ch;
    } else {
      add(letter, *viseme);
    }
    last_ = letter;
    tied_ = false;
  }

  void add(char32_t letter, Viseme viseme) {
    const bool vowel = is_vowel(viseme);
    Phone phone{.viseme = viseme, .nucleus = vowel, .word_begin = word_begin_};
    if (letter == U'ə') phone.strength = kWeak;
    if (is_semivowel(letter) || (vowel && tied_ && !phones_.empty() && phones_.back().nucleus)) make_glide(phone);
    word_begin_ = false;
    phones_.push_back(phone);
  }

  static void make_glide(Phone& phone) {
    if (!phone.nucleus) return;
    phone.nucleus = false;
    phone.length = kGlide;
  }

  std::vector<Phone> phones_;
  char32_t last_ = 0;
  bool word_begin_ = true;
  bool tied_ = false;
};

bool is_liquid(const Phone& phone) noexcept {
  return phone.viseme == Viseme::rr || phone.viseme == Viseme::nn || phone.viseme == Viseme::kk ||
         (is_vowel(phone.viseme) && !phone.nucleus);
}

}  // namespace

std::vector<Phone> phones_of_ipa(std::string_view ipa) {
  if (!is_utf8(ipa)) return {};
  return IpaReader().read(code_points(ipa));
}

std::vector<std::size_t> syllables_of(const std::vector<Phone>& phones) {
  std::vector<std::size_t> begins;
  std::size_t last_nucleus = 0;
  for (std::size_t i = 0; i < phones.size(); ++i) {
    if (!phones[i].nucleus) continue;
    if (begins.empty()) {
      begins.push_back(0);
    } else {
      std::size_t begin = i > last_nucleus + 1 ? i - 1 : i;
      if (begin > last_nucleus + 1 && begin < i && is_liquid(phones[begin]) && !phones[begin].word_begin) --begin;
      // A glide right after a vowel is the end of its diphthong.
      if (begin == last_nucleus + 1 && begin < i && is_vowel(phones[begin].viseme) && i > begin + 1) ++begin;
      begins.push_back(begin);
    }
    last_nucleus = i;
  }
  if (begins.empty() && !phones.empty()) begins.push_back(0);
  return begins;
}

}  // namespace signweave
