#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "signweave/annotation/document.h"
#include "signweave/space/locus.h"

namespace signweave {

/// What an annotated locus is to the sign that it lies over. The names of the tiers, in any case.
enum class LocusTier : std::uint8_t { from = 0, to = 1, at = 2 };

struct AnnotatedLocus {
  LocusTier tier = LocusTier::at;
  TimeSpan span;  ///< annotation time
  LocusRef locus;
  friend bool operator==(const AnnotatedLocus&, const AnnotatedLocus&) = default;
};

/// The loci on the tiers `From`, `To` and `At` of a document, whose labels read_locus can read, with or without "@".
std::vector<AnnotatedLocus> loci_in(const AnnotationDocument& document);

/// [LocusTier] the locus that covers most of a sign's time, at least half of it.
std::array<std::optional<LocusRef>, 3> loci_over(const std::vector<AnnotatedLocus>& all, TimeSpan sign);

}  // namespace signweave
