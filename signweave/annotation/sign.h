#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/annotation/document.h"
#include "signweave/core/error.h"
#include "signweave/core/time.h"

namespace signweave {

/// What a phase is (Kita, van Gijn, van der Hulst 1998). Stored on disk: never renumber.
enum class PhaseKind : unsigned char {
  preparation = 0,  ///< the hands move to where the stroke begins
  stroke = 1,       ///< the part with meaning
  retraction = 2,   ///< the hands leave or rest ("rest" is a built-in label of it)
  hold = 3,         ///< the hands keep still: kept as annotated; see Sign::stroke_span for what it counts as
  other = 4,        ///< a label that no mapping knows: kept, reported
};

/// "preparation", "stroke", …
std::string_view name_of(PhaseKind kind) noexcept;

/// One stretch of a sign.
struct Phase {
  PhaseKind kind = PhaseKind::stroke;
  TimeSpan span;
  std::string label;       ///< verbatim
  std::string annotation;  ///< id in the document; empty where inferred
  friend bool operator==(const Phase&, const Phase&) = default;
};

/// Which hand a tier describes. Stored on disk: never renumber.
enum class Hand : unsigned char { both = 0, right = 1, left = 2 };
std::string_view name_of(Hand hand) noexcept;

/// One occurrence of a gloss in a recording (the paper's Phrase, section 3.2, equation 2).
struct Sign {
  std::string gloss;  ///< verbatim
  TimeSpan span;
  std::vector<Phase> phases;  ///< in time order; at least one where `signs_in` made it
  Hand hand = Hand::both;
  std::string signer;      ///< the tier's participant, may be empty
  std::string tier;        ///< the sign tier's id
  std::string annotation;  ///< id in the document
  bool inferred = false;   ///< no phases annotated: the whole sign is taken as one stroke

  /// From the first stroke's begin to the last stroke's end, with all that lies between them, holds too. A hold before
  /// the first stroke or after the last one does not count, unless TierNames::phase_labels makes it a stroke: then its
  /// phase is one. None where the sign has no stroke: such a sign is never a candidate.
  std::optional<TimeSpan> stroke_span() const noexcept;
  /// From the sign's begin to the first stroke. Empty span where there is no preparation, or no stroke.
  TimeSpan preparation_span() const noexcept;
  /// From the last stroke to the sign's end. Empty span where there is no retraction, or no stroke.
  TimeSpan retraction_span() const noexcept;
  friend bool operator==(const Sign&, const Sign&) = default;
};

/// Which tiers hold signs and phases, given by a user or guessed.
struct TierNames {
  struct SignTier {
    std::string id;
    Hand hand = Hand::both;
    std::string signer;  ///< empty: the tier's participant
    friend bool operator==(const SignTier&, const SignTier&) = default;
  };
  std::vector<SignTier> sign_tiers;
  std::vector<std::string> phase_tiers;           ///< ids; each a descendant of a sign tier, or overlapping it in time
  std::map<std::string, PhaseKind> phase_labels;  ///< match form, case folded -> kind; adds to the built-in table
  friend bool operator==(const TierNames&, const TierNames&) = default;
};

/// Which tiers look like sign tiers and phase tiers: by name ("Gloss", "Glose RH", "Lexem_Gloss_l", "signs"), by
/// tier type, by structure (a time-subdivided child whose labels are phases). Hand and signer are read from the names
/// ("GlossL S1", "gloss@A"); a signer only where the tier names no participant. Best guess first where several hands or
/// signers have tiers: those with phases, then those with more annotations. Empty lists where nothing fits.
TierNames guess_tier_names(const AnnotationDocument& document);

/// The kind that a label stands for: the user's mapping, then the built-in table (English, French, German, Dutch,
/// Portuguese words and usual abbreviations: "prep", "S", "Préparation", "retr.", "hold"); `other` where unknown.
PhaseKind phase_kind_of(std::string_view label, const TierNames& names);

/// What `signs_in` found.
struct SignsFound {
  std::vector<Sign> signs;      ///< by sign tier as given, then time
  std::vector<Notice> notices;  ///< a sign that its phases do not fill exactly, unknown labels, phases outside any sign
};

/// The signs of a document. A sign whose annotation has no phase gets one inferred stroke over its whole span.
/// Empty labels are no signs.
///
/// A phase belongs to the sign that is its ancestor. On a phase tier that is under no sign tier it belongs to the sign
/// that holds it, else to the one it shares most time with; a hand or signer in the tier's name ("Phase RH") chooses
/// the sign tiers, else it is tried on all. Phases are kept as annotated, never cut to fit: a sign that its phases do
/// not fill exactly and in order (section 5.2 of the paper) is a notice. `where` of a notice is the tier.
/// Throws Error{not_found} with near matches where a named tier is not in the document.
SignsFound signs_in(const AnnotationDocument& document, const TierNames& names);

}  // namespace signweave
