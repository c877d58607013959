#pragma once

#include "signweave/retarget/character.h"
#include "signweave/retarget/json_value.h"

namespace signweave {

/// Reads hands, face units and sizes from `extras` (asset.extras.signweave). Precondition: `character.skeleton` is set.
void read_extras(const JsonValue& extras, Character& character);

}  // namespace signweave
