#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "signweave/database/database.h"

namespace signweave {

struct CheckResult {
  std::uint32_t recordings = 0;     ///< that the catalogue counts
  std::vector<std::string> faults;  ///< one line each, naming recording, joints and frames; empty where all is well
};

/// Verifies every stored byte of an open database.
CheckResult check(const Database& database, const Database::Progress& progress = {});

/// The same in a child process, so that damage to the engine's own pages, which may kill whoever reads them, is a fault
/// that is reported and not the end of this program. What lies behind such damage is looked at all the same, by another
/// child. Forks: call it where no other thread holds a lock that the child would need. Throws as opening the database
/// does.
CheckResult check_in_child(const std::filesystem::path& folder, const Database::Progress& progress = {});

/// What takes how much space (Database::usage), told by a child process for the same reason. Throws Error{corrupt}
/// where that died of it.
std::vector<Usage> usage_in_child(const std::filesystem::path& folder);

}  // namespace signweave
