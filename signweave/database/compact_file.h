#pragma once

#include <filesystem>

#include "signweave/database/database.h"
#include "signweave/kv/kv_store.h"

namespace signweave {

/// Gives the disk back what is free in a database's file: what was removed or replaced leaves room in it that later
/// recordings use, and that nobody else can. What is stored stays as it is, to the bit (kv::compact). Nobody may have
/// the database open meanwhile. Throws Error{conflict} where somebody has, else as Database does.
kv::Compacted compact_file(const std::filesystem::path& folder, const Database::Progress& progress = {});

}  // namespace signweave
