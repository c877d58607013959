#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/features/defects.h"

namespace signweave::calls {

/// Defects as a JSON array, complete. `skeleton` is the motion's.
nlohmann::json json_of(const std::vector<Defect>& defects, const Skeleton& skeleton);

/// Defects as a table: kind, joint, frames, what; empty where there is none. What a notice of the reader already says
/// is left out: a permuted root, an unusual unit.
std::string table_of(const std::vector<Defect>& defects, const Skeleton& skeleton, const std::vector<Notice>& notices);

}  // namespace signweave::calls
