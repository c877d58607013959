#pragma once

#include "signweave/retarget/character.h"
#include "signweave/retarget/json_value.h"

namespace signweave {

/// What `extras` (asset.extras.signweave) tells: hands, face units, sizes. `character.skeleton` is there.
void read_extras(const JsonValue& extras, Character& character);

}  // namespace signweave
