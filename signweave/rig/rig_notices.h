#pragma once

#include <string>
#include <vector>

#include "signweave/rig/rig_map.h"

namespace signweave {

/// What a map lacks, a line each.
std::vector<std::string> missing_parts(const RigMap& map);

}  // namespace signweave
