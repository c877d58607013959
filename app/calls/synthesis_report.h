#pragma once

#include <nlohmann/json.hpp>

#include "signweave/choose/concatenate.h"

namespace signweave::calls {

/// Signs, clips and junctions of a synthesis, without its poses.
nlohmann::json describe(const Synthesis& synthesis);

}  // namespace signweave::calls
