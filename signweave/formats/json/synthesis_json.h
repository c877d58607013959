#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "signweave/motion/motion.h"
#include "signweave/score/result.h"

/// Inside the library and its calls only: a motion and a synthesis as JSON (docs/synthesis.md describes the members).
namespace signweave {

/// Signs, clips ("stretches") and junctions of a synthesis, without its poses.
nlohmann::json report_json(const Synthesis& synthesis);

/// A motion: every pose, rotations as unit quaternions x y z w, translations in metres. One line.
std::string motion_json_text(const Motion& motion,
                             const std::vector<std::pair<std::string, std::string>>& declarations);

/// A synthesis: its report, every pose, and the source of each frame. One line.
std::string synthesis_json_text(const Synthesis& synthesis);

}  // namespace signweave
