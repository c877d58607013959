#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/query/find.h"
#include "signweave/semantic_db/segments.h"

namespace signweave {

/// How well a segment matches the words, best first.
enum class WordMatch : std::uint8_t {
  exact,     ///< a sign whose gloss is the words
  folded,    ///< as `exact`, ignoring case, accents and width (loose_form)
  sequence,  ///< consecutive signs, one per word
  part,      ///< a sign whose gloss contains the words at the start of one of its parts: "mans" in LE MANS
  label,     ///< the same for an annotation of another tier
  some,      ///< a sign that matches one of several words; only if none of the above was found
};
std::string_view word_of(WordMatch match) noexcept;

struct WordAnswer {
  Segment segment;
  WordMatch match = WordMatch::exact;
  friend bool operator==(const WordAnswer&, const WordAnswer&) = default;
};

/// The words of a text without operators of the query language, separated by white space, commas or semicolons; quoted
/// text is one word. Returns nullopt if the text has an operator or an unclosed quotation mark, or has no word.
std::optional<std::vector<std::string>> bare_words(std::string_view text);

/// The segments that match the words: best match first, then by recording, begin and end; each segment appears once,
/// with its best match. Time grows with the number of distinct labels and of results. Throws Error{cancelled} if
/// `limits` require it.
std::vector<WordAnswer> find_words(const std::vector<std::string>& words, const Segments& segments,
                                   const FindLimits& limits = {});

/// Hints for words that match nothing: similar glosses, and what a word is if it is not a gloss, such as a recording.
std::vector<Notice> word_hints(const std::vector<std::string>& words, const Segments& segments);

/// Whether the text is the gloss of a sign when both are compared in loose form (loose_form).
bool is_loosely_a_gloss(std::string_view text, const Segments& segments);

}  // namespace signweave
