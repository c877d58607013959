#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "signweave/space/locus.h"
#include "signweave/space/roles.h"

namespace re2 {
class RE2;
}

namespace signweave {

/// A gloss of a corpus that names loci in itself, such as GIVE-1-i.
struct GlossLoci {
  std::string gloss;  ///< without its loci
  std::optional<LocusRef> from;
  std::optional<LocusRef> to;
  std::optional<LocusRef> at;
  friend bool operator==(const GlossLoci&, const GlossLoci&) = default;
};

/// How a corpus writes loci in its glosses. Immutable; copies share it.
struct LocusPattern {
  std::shared_ptr<const re2::RE2> regex;
};

/// Compiles a pattern: a regular expression (RE2) for a whole gloss, in which the groups `(?<from>…)`, `(?<to>…)` and
/// `(?<at>…)`, at least one of them, are words for loci, and `(?<gloss>…)` is the gloss without them. Throws
/// Error{bad_input} with what is wrong with it. Matching is linear in the length of the gloss.
LocusPattern locus_pattern(std::string_view pattern);
inline constexpr std::size_t kLongestLocusPattern = 1'000;  ///< bytes

/// What the first pattern that matches says about a gloss. One that captures a word that is not in `words` does not
/// match, so FAX-ON remains one gloss. None if no pattern matches.
std::optional<GlossLoci> loci_of(std::string_view gloss, std::span<const LocusPattern> patterns,
                                 const LocusWords& words);

/// Patterns of conventions that corpora use, for usual_locus_words(): INDEX_left and IX-3a, GIVE-1-i, 1GIVE2.
std::span<const std::string_view> usual_locus_patterns() noexcept;

}  // namespace signweave
