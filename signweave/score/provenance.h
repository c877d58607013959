#pragma once

#include <string>

#include "signweave/annotation/document.h"
#include "signweave/score/result.h"

namespace signweave {

/// A synthesis as an annotation document, so that ELAN can show where each part comes from. Tiers: "Gloss" (the signs),
/// "Phase" (its child, filling each sign), "Source" (each clip of captured frames: its recording and position there),
/// "Junction" (each transition: method, joined signs, cut points). A channel that shows something else than the body
/// adds tiers of its own, such as "Gloss left" (the signs of that channel alone), "Phase left", "Source left",
/// "Junction left" and "Hold left" (poses that are held). Authored movements are on the tiers "Mouth" (mouthed texts),
/// "Gaze" and "Expression", and where some overlap, "Expression 2" and so on. `motion_file` is linked if it is not
/// empty.
AnnotationDocument annotation_of(const Synthesis& synthesis, const std::string& motion_file = {});

}  // namespace signweave
