#pragma once

#include "app/calls/json.h"
#include "signweave/database/database.h"

namespace signweave::calls {

/// What can be asked for in a database, and the words of the language that asks: for completion.
nlohmann::ordered_json vocabulary_json(const Database& database);

}  // namespace signweave::calls
