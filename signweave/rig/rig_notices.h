#pragma once

#include <string>
#include <vector>

#include "signweave/rig/rig_map.h"

namespace signweave {

/// The parts that a map lacks, one line each.
std::vector<std::string> missing_parts(const RigMap& map);

}  // namespace signweave
