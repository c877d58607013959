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

/// Parses glosses separated by white space. Only double quotes quote, and everything inside them is literal. `MATIN#3`
/// is a token, `"ISL Thanks"@1200..3400` a piece of a recording in ms; `,` and `.` as separate words are pauses
/// (ignored before the first and after the last sign). Throws Error{bad_input, "utterance:1:COLUMN: …"}, also for an
/// utterance without a sign.
Utterance parse_utterance(std::string_view text);

/// Returns text that parses to the same utterance.
std::string to_string(const Utterance& utterance);
std::string to_string(const GlossRef& gloss);

/// Parses "MATIN", "MATIN#3", "\"LE MANS\"#2". Throws as parse_utterance; `what` names the text in the error.
GlossRef parse_gloss_ref(std::string_view text, std::string_view what);

/// The first position of `separator` outside double quotes, at or after `from`; or npos.
std::size_t find_unquoted(std::string_view text, std::string_view separator, std::size_t from = 0) noexcept;

}  // namespace signweave
