#pragma once

#include <string>

#include "signweave/formats/eaf/elements.h"

namespace signweave::eaf {

/// Returns a complete EAF 3.0 file for a document that has no source. TIME_ORDER is sorted, with every slot of a child
/// between those of its parent; tiers are written parents first; types, languages and vocabularies that are only
/// referred to are declared. On a Time_Subdivision tier neighbours share their slots, and the outer slots are the
/// parent's.
///
/// Unaligned annotations there get unaligned slots if ELAN would show them at the times they have; a boundary that ELAN
/// would show elsewhere gets its time instead.
std::string generate(const CheckedDocument& checked);

}  // namespace signweave::eaf
