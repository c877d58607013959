#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/time.h"

namespace signweave {

/// A gloss, perhaps one token of it.
struct GlossRef {
  std::string gloss;      ///< as typed
  std::size_t token = 0;  ///< from 1: counted by recording name, then time; 0: any
  friend bool operator==(const GlossRef&, const GlossRef&) = default;
};

/// One thing to be signed.
struct Place {
  enum class Kind { gloss, piece };
  Kind kind = Kind::gloss;
  GlossRef gloss;                ///< of a gloss
  std::string recording;         ///< of a piece of a recording
  TimeSpan span;                 ///< of a piece: annotation time
  Milliseconds pause_before{0};  ///< extra time before it
  friend bool operator==(const Place&, const Place&) = default;
};

/// What "," and "." standing alone add to the transition.
inline constexpr Milliseconds kComma{350};
inline constexpr Milliseconds kFullStop{800};

/// The glosses asked for, in order (the paper's sign string).
struct Utterance {
  std::vector<Place> places;
  friend bool operator==(const Utterance&, const Utterance&) = default;
};

/// Glosses separated by white space. Only double quotes quote, and inside them everything is literal. `MATIN#3` is a
/// token, `"ISL Thanks"@1200..3400` a piece of a recording in ms, `,` and `.` standing alone are pauses (before the
/// first and after the last sign they say nothing). Throws Error{bad_input, "utterance:1:COLUMN: …"}; an utterance
/// without a sign is one.
Utterance parse_utterance(std::string_view text);

/// Text that parses to the same utterance.
std::string to_string(const Utterance& utterance);
std::string to_string(const GlossRef& gloss);

/// "MATIN", "MATIN#3", "\"LE MANS\"#2". Throws as parse_utterance; `what` names the text in the error.
GlossRef parse_gloss_ref(std::string_view text, std::string_view what);

/// Where a double quote is not open: the first place of `separator` at or after `from`, or npos.
std::size_t find_unquoted(std::string_view text, std::string_view separator, std::size_t from = 0) noexcept;

}  // namespace signweave
