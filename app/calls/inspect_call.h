#pragma once

#include <filesystem>
#include <functional>

#include "app/calls/json.h"
#include "app/calls/listener.h"
#include "signweave/database/import.h"

namespace signweave::calls {

/// What an import of some files would store, recording by recording, and what was guessed for it: a person looks at it,
/// and imports then. It is found out by importing into a database of its own in `scratch`, a folder that must not exist
/// and is gone afterwards; `database` is only asked what it knows. What an earlier import of a known recording was told
/// is not gone by. `done` is given each recording as JSON; Error{cancelled}, which progress may throw, ends it.
void inspect(const Database& database, const Pairing& pairing, const ImportOptions& options,
             const std::filesystem::path& scratch, const Listener& listener,
             const std::function<void(nlohmann::ordered_json)>& done);

}  // namespace signweave::calls
