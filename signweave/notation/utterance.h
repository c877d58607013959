#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/rig/part.h"
#include "signweave/space/change.h"

namespace signweave {

/// A gloss, optionally with a token number.
struct GlossRef {
  std::string gloss;      ///< as typed
  std::size_t token = 0;  ///< from 1, in order of recording name, then time; 0: any
  friend bool operator==(const GlossRef&, const GlossRef&) = default;
};

/// A sign of the database, or a piece of a recording.
struct SignRef {
  enum class Kind { gloss, piece };
  Kind kind = Kind::gloss;
  GlossRef gloss;         ///< for a gloss
  std::string recording;  ///< for a piece: the recording
  TimeSpan span;          ///< for a piece: annotation time
  friend bool operator==(const SignRef&, const SignRef&) = default;
};

/// A part of the signer as a text names it. A hand is named by its side or by its role; a hand includes its arm.
enum class BodyPart : std::uint8_t {
  dominant,
  weak,
  right,
  left,
  dominant_fingers,
  weak_fingers,
  right_fingers,
  left_fingers,
  head,
};
inline constexpr std::array kBodyParts = {
    BodyPart::dominant,     BodyPart::weak,          BodyPart::right,        BodyPart::left, BodyPart::dominant_fingers,
    BodyPart::weak_fingers, BodyPart::right_fingers, BodyPart::left_fingers, BodyPart::head};
/// Returns "weak", "right fingers", …
std::string_view name_of(BodyPart part) noexcept;

/// Ties the stroke of a part's sign to the stroke of the place that it accompanies.
struct SyncMark {
  enum class Anchor : std::uint8_t { begin, end };
  Anchor anchor = Anchor::begin;
  Milliseconds offset{0};  ///< from the place's anchor to the same anchor of the part's sign
  friend bool operator==(const SyncMark&, const SyncMark&) = default;
};

/// A sign of one part of the signer, or a rest of a hand.
struct PartSign {
  SignRef sign;                ///< not used for a rest
  std::vector<SyncMark> sync;  ///< empty: the first of its part begins with the place, another follows the previous one
  bool rest = false;           ///< the hand is lowered to the signer's rest, and stays there until it is needed
  friend bool operator==(const PartSign&, const PartSign&) = default;
};

/// What one part of the signer does while some places are signed, instead of its share of them.
struct PlacePart {
  BodyPart part = BodyPart::weak;
  std::vector<PartSign> signs;  ///< not empty
  std::size_t places = 1;       ///< the number of consecutive places that it accompanies
  friend bool operator==(const PlacePart&, const PlacePart&) = default;
};

/// One item to be signed.
struct Place : SignRef {
  Milliseconds pause_before{0};  ///< extra time before it
  std::vector<PlacePart> parts;  ///< those that begin with it, each part once, in the order of the text
  std::optional<Side> dominant;  ///< the hand that signs it as the dominant one; none: the signer's
  SpaceChange space;             ///< where it goes, and how its strokes are changed
  friend bool operator==(const Place&, const Place&) = default;
};

/// A place that is signed with the whole body.
inline Place place_of(GlossRef gloss) {
  Place place;
  place.gloss = std::move(gloss);
  return place;
}

/// Time that "," and "." as separate words add to the transition.
inline constexpr Milliseconds kComma{350};
inline constexpr Milliseconds kFullStop{800};

/// Stands for the last place before an utterance that is appended to another one.
inline constexpr std::size_t kPlaceBefore = static_cast<std::size_t>(-1);

/// A hand that keeps its pose at the end of a place's stroke.
struct HandHold {
  BodyPart hand = BodyPart::weak;  ///< dominant, weak, right or left
  std::size_t from = 0;            ///< the place, from 0; kPlaceBefore only if UtteranceWords::follows
  std::size_t until = 0;           ///< the place whose stroke's end ends the hold; after `from`
  friend bool operator==(const HandHold&, const HandHold&) = default;
};

/// A movement of the face, the gaze or the head over consecutive places.
struct NonManual {
  enum class Kind : std::uint8_t {
    expression,  ///< `what` is the name of an expression, such as "brows up"
    mouthing,    ///< `what` is the text to be mouthed
    gaze,        ///< `what` is a direction or a locus without its "@", such as "left", "addressee" or "30/10"
  };
  Kind kind = Kind::expression;
  std::string what;
  std::size_t first = 0;  ///< place, from 0
  std::size_t last = 0;   ///< inclusive
  Milliseconds begin{0};  ///< added to its usual begin
  Milliseconds end{0};    ///< added to its usual end
  friend bool operator==(const NonManual&, const NonManual&) = default;
};

/// The requested glosses, in order (the paper's sign string), and what parts of the signer do besides.
struct Utterance {
  std::vector<Place> places;
  std::vector<HandHold> holds;         ///< in the order of their begins
  std::vector<NonManual> non_manuals;  ///< in the order of their begins; an outer one before those inside it
  std::vector<LocusSetup> loci = {};   ///< in the order of their places; each name once at a place
  friend bool operator==(const Utterance&, const Utterance&) = default;
};

/// The number of signs in an utterance: of its places and of their parts.
inline std::size_t count_signs(const Utterance& utterance) {
  std::size_t count = utterance.places.size();
  for (const Place& place : utterance.places) {
    for (const PlacePart& part : place.parts) count += part.signs.size();
  }
  return count;
}

/// The position of a word in the text of an utterance, in bytes; half-open.
struct WordSpan {
  std::size_t begin = 0;
  std::size_t end = 0;
  friend bool operator==(const WordSpan&, const WordSpan&) = default;
};

/// A part of a text that asks for nothing that can be signed.
struct UtteranceFault {
  enum class Kind : std::uint8_t {
    open_quote,
    empty_name,
    bad_suffix,
    token_zero,
    piece_order,
    too_long,
    open_bracket,        ///< `[` or `{` is never closed
    stray_bracket,       ///< a bracket that belongs to nothing, often of a gloss that needs quotes
    nested_bracket,      ///< `[` inside `[ ]`
    too_deep,            ///< more than kMostUtteranceDepth brackets inside each other
    empty_group,         ///< a bracket, a part or a scope without a sign
    unknown_part,        ///< not one of kBodyParts
    repeated_part,       ///< a part, a hold or `dominant` is given twice for the same places
    bad_option,          ///< an option that cannot be read
    unknown_expression,  ///< UtteranceWords::is_expression does not know it
    bad_sync,            ///< a word with `@` that is not a sync mark, or does not follow a sign of a part
    pause_in_part,       ///< `,` or `.` among the signs of a part
    nothing_to_hold,     ///< a hold at the first place
    no_such_place,       ///< `..GLOSS` or `..+COUNT` finds no place
    long_mouthing,       ///< more than kMostMouthingCharacters
    bad_locus,           ///< no locus, or one that cannot be set up
    unknown_locus,       ///< a locus that is neither built in nor set up by that place
    repeated_option,     ///< a change in space, or a locus, is given twice for the same place
  };
  Kind kind = Kind::open_quote;
  WordSpan at;              ///< of an open quote: to the end of the text
  std::string message;      ///< what is wrong and how to fix it, in one line
  std::string replacement;  ///< the text of `at` without this fault; empty if only the author can know it
};
inline constexpr std::size_t kUtteranceFaultKinds = 23;

/// The maximum number of faults that are reported for one text.
inline constexpr std::size_t kMostUtteranceFaults = 20;
/// The maximum number of brackets and scopes inside each other.
inline constexpr std::size_t kMostUtteranceDepth = 32;
/// In code points.
inline constexpr std::size_t kMostMouthingCharacters = 1'000;
/// Of the offsets of sync marks and non-manuals, either way.
inline constexpr Milliseconds kMostUtteranceOffset{1'000'000};

/// Returns "open_quote", "empty_name", …
std::string_view name_of(UtteranceFault::Kind kind) noexcept;

/// The words that a database and its users know. Functions may be empty.
struct UtteranceWords {
  /// A word for which it is true is that gloss, whatever brackets, `|`, `@`, … it contains; of several such beginnings
  /// of a word the longest is. Called only for words with such characters, for `hold` and for `rest`. Empty: false.
  std::function<bool(std::string_view)> is_gloss;
  /// Whether an expression exists. Empty: true, except for those that are called as a change in space, such as `slow`.
  std::function<bool(std::string_view)> is_expression;
  /// The expressions whose names are similar, the nearest first. Called for those that do not exist. Empty: none.
  std::function<std::vector<std::string>(std::string_view)> near_expressions = {};
  /// The text follows other places, so a hand can be held in its first one, and loci may be set up before it.
  bool follows = false;
};

/// The content of a text that may have faults.
struct UtteranceText {
  Utterance utterance;                 ///< what has no fault; may be empty
  std::vector<WordSpan> spans;         ///< [place] its word, with the options directly behind it
  Milliseconds pause_after{0};         ///< of `,` and `.` after the last sign
  std::vector<UtteranceFault> faults;  ///< in the order of the text, at most kMostUtteranceFaults
};

/// Reads the notation of utterances (docs/utterance.md): glosses separated by white space. Only double quotes quote,
/// and everything inside them is literal, `""` a quote. `MATIN#3` is a token, `"ISL Thanks"@1200..3400` a piece of a
/// recording in ms; `,` and `.` as separate words are pauses (ignored before the first sign). `[A | weak: B]` is what
/// parts of the signer do meanwhile, `A{mouth "a"}` and `A{to @left}` are options of a place, `{brows up: A B}` is a
/// scope. Faulty words are left out and reported. The time is linear in the length of the text.
UtteranceText read_utterance(std::string_view text, const UtteranceWords& words = {});

/// Returns the utterance of a text without faults. Throws Error{bad_input, "utterance:LINE:COLUMN: …"} for the first
/// fault, the column from 1 in characters (code points), and for an utterance without a sign.
Utterance parse_utterance(std::string_view text, const UtteranceWords& words = {});

/// Returns text that parses to the same utterance, whatever glosses are known: names with brackets are quoted. Requires
/// names that are not blank, and places, parts and times as this file describes them. Leaves out what is held from
/// before the utterance.
std::string to_string(const Utterance& utterance);
std::string to_string(const GlossRef& gloss);
/// The options of a change, without braces: "from @self to @a; big".
std::string to_string(const SpaceChange& change);

/// Parses "MATIN", "MATIN#3", "\"LE MANS\"#2". Throws as parse_utterance; `what` names the text in the error.
GlossRef parse_gloss_ref(std::string_view text, std::string_view what);

/// The first position of `separator` outside double quotes, at or after `from`; or npos.
std::size_t find_unquoted(std::string_view text, std::string_view separator, std::size_t from = 0) noexcept;

}  // namespace signweave
