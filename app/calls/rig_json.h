#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "signweave/rig/rig_map.h"

namespace signweave::calls {

/// "name", "shape", "file", "none".
std::string_view name_of(Evidence evidence);

/// Every part that is known, with joint, offset, evidence and confidence.
nlohmann::ordered_json json_of_rig(const Skeleton& skeleton, const RigMap& map);

}  // namespace signweave::calls
