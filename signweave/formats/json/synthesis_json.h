#pragma once

#include <string>

#include "signweave/annotation/declarations.h"
#include "signweave/motion/motion.h"
#include "signweave/score/result.h"

/// Inside the library only: a motion and a synthesis as JSON (docs/synthesis.md describes the members).
namespace signweave {

/// A motion: every pose, rotations as unit quaternions x y z w, translations in metres. One line.
std::string motion_json_text(const Motion& motion, const Declarations& declarations);

/// A synthesis: its report, every pose, and the source of each frame. One line.
std::string synthesis_json_text(const Synthesis& synthesis);

}  // namespace signweave
