#pragma once

#include <string>

#include "signweave/annotation/document.h"
#include "signweave/score/result.h"

namespace signweave {

/// A synthesis as an annotation document, so that ELAN shows what was made of what. Tiers: "Gloss" (the signs), "Phase"
/// (its child, filling each sign), "Source" (each clip of captured frames: recording and where it was there),
/// "Junction" (each transition: method, what it joins, how it was cut). `motion_file` is linked where it is not empty.
AnnotationDocument annotation_of(const Synthesis& synthesis, const std::string& motion_file = {});

}  // namespace signweave
