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

/// The kind of a phase (Kita, van Gijn, van der Hulst 1998). Stored on disk: never renumber.
enum class PhaseKind : unsigned char {
  preparation = 0,  ///< the hands move to the start of the stroke
  stroke = 1,       ///< the part that carries the meaning
  retraction = 2,   ///< the hands move away or rest ("rest" is a built-in label for it)
  hold = 3,         ///< the hands keep still; stored as annotated, see Sign::stroke_span for how it counts
  other = 4,        ///< a label that no mapping contains: stored and reported
};

/// Returns "preparation", "stroke", …
std::string_view name_of(PhaseKind kind) noexcept;

/// One phase of a sign.
struct Phase {
  PhaseKind kind = PhaseKind::stroke;
  TimeSpan span;
  std::string label;       ///< verbatim
  std::string annotation;  ///< id in the document; empty if inferred
  friend bool operator==(const Phase&, const Phase&) = default;
};

/// Which hand a tier describes. Stored on disk: never renumber.
enum class Hand : unsigned char { both = 0, right = 1, left = 2 };
std::string_view name_of(Hand hand) noexcept;

/// One occurrence of a gloss in a recording (the paper's Phrase, section 3.2, equation 2).
struct Sign {
  std::string gloss;  ///< verbatim
  TimeSpan span;
  std::vector<Phase> phases;  ///< in time order; at least one if `signs_in` built the sign
  Hand hand = Hand::both;
  std::string signer;      ///< the tier's participant, may be empty
  std::string tier;        ///< the sign tier's id
  std::string annotation;  ///< id in the document
  bool inferred = false;   ///< no phases are annotated: the whole sign counts as one stroke

  /// From the start of the first stroke to the end of the last one, including everything in between, even holds. A hold
  /// before the first stroke or after the last one does not count, unless TierNames::phase_labels maps its label to
  /// stroke. Empty if the sign has no stroke: such a sign is never a candidate.
  std::optional<TimeSpan> stroke_span() const noexcept;
  /// From the start of the sign to the first stroke. An empty span if there is no preparation or no stroke.
  TimeSpan preparation_span() const noexcept;
  /// From the last stroke to the end of the sign. An empty span if there is no retraction or no stroke.
  TimeSpan retraction_span() const noexcept;
  friend bool operator==(const Sign&, const Sign&) = default;
};

/// The tiers that hold signs and phases, given by a user or guessed.
struct TierNames {
  struct SignTier {
    std::string id;
    Hand hand = Hand::both;
    std::string signer;  ///< if empty, the tier's participant
    friend bool operator==(const SignTier&, const SignTier&) = default;
  };
  std::vector<SignTier> sign_tiers;
  std::vector<std::string> phase_tiers;           ///< ids; each a descendant of a sign tier, or overlapping it in time
  std::map<std::string, PhaseKind> phase_labels;  ///< match form, case folded -> kind; extends the built-in table
  friend bool operator==(const TierNames&, const TierNames&) = default;
};

/// Guesses which tiers are sign tiers and phase tiers: by name ("Gloss", "Glose RH", "Lexem_Gloss_l", "signs"), by tier
/// type, and by structure (a time-subdivided child whose labels are phases). Hand and signer are read from the names
/// ("GlossL S1", "gloss@A"); the signer only if the tier names no participant. If several hands or signers have tiers,
/// the best guess comes first: tiers with phases, then tiers with more annotations. The lists are empty if nothing
/// fits.
TierNames guess_tier_names(const AnnotationDocument& document);

/// The kind of phase that a label denotes. The user's mapping is searched first, then the built-in table (English,
/// French, German, Dutch, Portuguese words and usual abbreviations: "prep", "S", "Préparation", "retr.", "hold");
/// `other` if the label is unknown.
PhaseKind phase_kind_of(std::string_view label, const TierNames& names);

/// The result of `signs_in`.
struct SignsFound {
  std::vector<Sign> signs;      ///< by sign tier in the given order, then by time
  std::vector<Notice> notices;  ///< signs not exactly filled by phases, unknown labels, phases outside any sign
};

/// Returns the signs of a document. A sign whose annotation has no phase gets one inferred stroke over its whole span.
/// An empty label is not a sign.
///
/// A phase belongs to the sign that is its ancestor. On a phase tier that has no sign tier among its ancestors, it
/// belongs to the sign that contains it, or else to the one with which it shares most time. A hand or signer in the
/// tier's name ("Phase RH") selects the sign tiers; otherwise all sign tiers are tried. Phases are stored as annotated
/// and never cut to fit: a sign that its phases do not fill exactly and in order (section 5.2 of the paper) causes a
/// notice, whose `where` is the tier. Throws Error{not_found} with near matches if a named tier is not in the document.
SignsFound signs_in(const AnnotationDocument& document, const TierNames& names);

}  // namespace signweave
