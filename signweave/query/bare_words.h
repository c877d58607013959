#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/query/find.h"
#include "signweave/semantic_db/segments.h"

namespace signweave {

/// How a segment fits words, the better first.
enum class WordMatch : std::uint8_t {
  exact,     ///< a sign whose gloss is the words
  folded,    ///< but for case, accents, width (loose_form)
  sequence,  ///< signs one after the other, a word each
  part,      ///< a sign in whose gloss the words stand, from the beginning of a part of it: "mans" in LE MANS
  label,     ///< likewise an annotation of another tier
  some,      ///< a sign of one of several words, where nothing of the above was found
};
std::string_view word_of(WordMatch match) noexcept;

struct WordAnswer {
  Segment segment;
  WordMatch match = WordMatch::exact;
  friend bool operator==(const WordAnswer&, const WordAnswer&) = default;
};

/// The words of a text that has none of the query language's operators: separated by white space, commas or
/// semicolons; what stands between quotation marks is one. None where an operator stands in it, where a quotation mark
/// is not closed, or where there is no word.
std::optional<std::vector<std::string>> bare_words(std::string_view text);

/// What fits words: the better first, then by recording, begin and end; each segment once, as what fits best. The time
/// it takes grows with the different labels and with what is found. Throws Error{cancelled} where `limits` say so.
std::vector<WordAnswer> find_words(const std::vector<std::string>& words, const Segments& segments,
                                   const FindLimits& limits = {});

/// For words that nothing fits: glosses that are near, and what a word is if it is no gloss, such as a recording.
std::vector<Notice> word_hints(const std::vector<std::string>& words, const Segments& segments);

/// Whether some sign's gloss is this text but for what loose_form leaves out.
bool is_loosely_a_gloss(std::string_view text, const Segments& segments);

}  // namespace signweave
