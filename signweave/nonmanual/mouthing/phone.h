#pragma once

#include <string_view>
#include <vector>

#include "signweave/nonmanual/mouthing/viseme.h"

namespace signweave {

/// A sound as it is seen.
struct Phone {
  Viseme viseme = Viseme::silence;
  bool nucleus = false;     ///< the vowel of a syllable; the second part of a diphthong is none
  bool word_begin = false;  ///< the first of its word
  float length = 1;         ///< relative to others of its viseme: 1.4 for a long vowel, 0.6 for the end of a diphthong
  float strength = 1;       ///< how far its shape is made: less for ə
  friend bool operator==(const Phone&, const Phone&) = default;
};

/// The visible sounds of a pronunciation in IPA, as espeak-ng prints it with --ipa=3 or as letter rules give it. Words
/// are separated by white space; stress marks and languages in parentheses are skipped, U+200D and U+0361 tie two
/// letters to one sound. Sounds that are not seen (h, ʔ) and letters that are not IPA are left out.
std::vector<Phone> phones_of_ipa(std::string_view ipa);

/// The index of the first phone of each syllable: a consonant between two vowels begins the second syllable; of several
/// the last does, with a liquid after it.
std::vector<std::size_t> syllables_of(const std::vector<Phone>& phones);

}  // namespace signweave
