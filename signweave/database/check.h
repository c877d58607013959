#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "signweave/database/database.h"

namespace signweave {

struct CheckResult {
  std::uint32_t recordings = 0;     ///< according to the catalogue
  std::vector<std::string> faults;  ///< one line each, with recording, joints and frames; empty: none
};

/// Verifies every stored byte of an open database.
CheckResult check(const Database& database, const Database::Progress& progress = {});

/// The same in a child process: damage to the engine's own pages may crash the process that reads them, so it is
/// reported as a fault and does not end this program. Another child continues after such damage. Forks: no other thread
/// may hold a lock that the child needs. Throws as opening the database does.
CheckResult check_in_child(const std::filesystem::path& folder, const Database::Progress& progress = {});

/// Returns Database::usage, determined in a child process for the same reason. Throws Error{corrupt} if the child
/// crashed.
std::vector<Usage> usage_in_child(const std::filesystem::path& folder);

}  // namespace signweave
