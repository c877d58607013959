#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/time.h"

namespace signweave {

/// A gloss, optionally with a token number.
struct GlossRef {
  std::string gloss;      ///< as typed
  std::size_t token = 0;  ///< from 1, in order of recording name, then time; 0: any
  friend bool operator==(const GlossRef&, const GlossRef&) = default;
};

/// One item to be signed.
struct Place {
  enum class Kind { gloss, piece };
  Kind kind = Kind::gloss;
  GlossRef gloss;                ///< for a gloss
  std::string recording;         ///< for a piece: the recording
  TimeSpan span;                 ///< for a piece: annotation time
  Milliseconds pause_before{0};  ///< extra time before it
  friend bool operator==(const Place&, const Place&) = default;
};

/// Time that "," and "." as separate words add to the transition.
inline constexpr Milliseconds kComma{350};
inline constexpr Milliseconds kFullStop{800};

/// The requested glosses, in order (the paper's sign string).
struct Utterance {
  std::vector<Place> places;
  friend bool operator==(const Utterance&, const Utterance&) = default;
};

/// The position of a word in the text of an utterance, in bytes; half-open.
struct WordSpan {
  std::size_t begin = 0;
  std::size_t end = 0;
  friend bool operator==(const WordSpan&, const WordSpan&) = default;
};

/// A word that asks for nothing that can be signed.
struct UtteranceFault {
  enum class Kind { open_quote, empty_name, bad_suffix, token_zero, piece_order, too_long };
  Kind kind = Kind::open_quote;
  WordSpan at;              ///< of an open quote: to the end of the text
  std::string message;      ///< what is wrong and how to fix it, in one line
  std::string replacement;  ///< the word without this fault; empty if only the author can know it
};

/// The maximum number of faults that are reported for one text.
inline constexpr std::size_t kMostUtteranceFaults = 20;

/// Returns "open_quote", "empty_name", …
std::string_view name_of(UtteranceFault::Kind kind) noexcept;

/// The content of a text that may have faults.
struct UtteranceText {
  Utterance utterance;                 ///< the words without a fault; may be empty
  std::vector<WordSpan> spans;         ///< [place]
  Milliseconds pause_after{0};         ///< of `,` and `.` after the last sign
  std::vector<UtteranceFault> faults;  ///< in the order of the text, at most kMostUtteranceFaults
};

/// Reads glosses separated by white space. Only double quotes quote, and everything inside them is literal. `MATIN#3`
/// is a token, `"ISL Thanks"@1200..3400` a piece of a recording in ms; `,` and `.` as separate words are pauses
/// (ignored before the first sign). Faulty words are left out and reported.
UtteranceText read_utterance(std::string_view text);

/// Returns the utterance of a text without faults. Throws Error{bad_input, "utterance:1:COLUMN: …"} for the first
/// fault, the column from 1 in characters (code points), and for an utterance without a sign.
Utterance parse_utterance(std::string_view text);

/// Returns text that parses to the same utterance.
std::string to_string(const Utterance& utterance);
std::string to_string(const GlossRef& gloss);

/// Parses "MATIN", "MATIN#3", "\"LE MANS\"#2". Throws as parse_utterance; `what` names the text in the error.
GlossRef parse_gloss_ref(std::string_view text, std::string_view what);

/// The first position of `separator` outside double quotes, at or after `from`; or npos.
std::size_t find_unquoted(std::string_view text, std::string_view separator, std::size_t from = 0) noexcept;

}  // namespace signweave
