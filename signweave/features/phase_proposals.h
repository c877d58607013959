#pragma once

#include <string>

#include "signweave/annotation/document.h"
#include "signweave/features/segmenter.h"

namespace signweave {

/// Proposals as a document for a person to check: for each hand that is there a tier "Phase RH (proposed)" or "Phase LH
/// (proposed)", labels as `name_of` gives them, and under it "Confidence RH" or "Confidence LH", one label each such as
/// "0.83". Times are whole milliseconds of the motion, whose frame 0 is at 0; what lies after `length`, or rounds to
/// nothing, is left out. `motion_file` is linked, by its name alone: keep both files in one folder. The property
/// "signweave:proposed" says that nobody has checked this yet.
AnnotationDocument proposals_document(const ProposedPhases& proposed, Seconds length, const std::string& motion_file);

/// What users are told wherever proposals are shown or stored.
inline constexpr std::string_view kProposalWarning =
    "these phases are proposed from motion alone; a person must check them";

}  // namespace signweave
