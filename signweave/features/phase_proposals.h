#pragma once

#include <string>

#include "signweave/annotation/document.h"
#include "signweave/features/segmenter.h"

namespace signweave {

/// Returns proposals as a document for manual checking. Each existing hand has a tier "Phase RH (proposed)" or "Phase
/// LH (proposed)", labelled with `name_of`, and below it "Confidence RH" or "Confidence LH", with one label such as
/// "0.83" each. Times are whole milliseconds of the motion, whose frame 0 is at 0; phases after `length`, and those
/// that round to an empty span, are omitted. `motion_file` is linked by its name only: keep both files in one folder.
/// The property "signweave:proposed" records that the proposals have not been checked.
AnnotationDocument proposals_document(const ProposedPhases& proposed, Seconds length, const std::string& motion_file);

/// The warning shown wherever proposals are displayed or stored.
inline constexpr std::string_view kProposalWarning =
    "these phases are proposed from motion alone; a person must check them";

}  // namespace signweave
