#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "signweave/calls/annotate_call.h"

namespace signweave::wire {

/// Reads {"remove", "tiers", "properties"}, as the schema describes it. Throws Error{bad_input, "FIELD: …"}.
calls::TierChanges tier_changes_from_json(std::string_view text);

/// The schema of that document.
nlohmann::ordered_json tier_changes_schema();

}  // namespace signweave::wire
