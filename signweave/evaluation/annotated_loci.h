#pragma once

#include <span>
#include <vector>

#include "signweave/annotation/document.h"
#include "signweave/annotation/sign.h"
#include "signweave/core/error.h"
#include "signweave/inflection/aim.h"

namespace signweave {

struct AnnotatedLoci {
  std::vector<LociOfSign> of;  ///< [sign]; empty if no sign has one
  std::vector<Notice> notices;
};

/// The loci of signs: of the tiers From, To and At (in any case), the annotation that covers most of a sign, and at
/// least half of it, is read by read_locus. A label that is no locus, or a name that an utterance would have to set up,
/// is a notice.
AnnotatedLoci annotated_loci(const AnnotationDocument& document, std::span<const Sign> signs, const SignerBody& body);

}  // namespace signweave
