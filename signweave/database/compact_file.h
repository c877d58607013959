#pragma once

#include <filesystem>

#include "signweave/database/database.h"
#include "signweave/kv/kv_store.h"

namespace signweave {

/// Returns the free space in a database's file to the disk: removed or replaced recordings leave space that only later
/// recordings can use. Everything stored stays the same, to the bit (kv::compact). Throws Error{conflict} if the
/// database is open elsewhere, else as Database does.
kv::Compacted compact_file(const std::filesystem::path& folder, const Database::Progress& progress = {});

}  // namespace signweave
