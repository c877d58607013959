#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/database/database.h"
#include "signweave/database/import_options.h"
#include "signweave/database/import_plan.h"
#include "signweave/database/pairing.h"

namespace signweave {

struct ImportReport {
  std::string name;  ///< of the recording; the job's, or the one under which the same files are stored already
  ImportOutcome outcome = ImportOutcome::unchanged;
  std::int64_t frames = 0;   ///< of the motion after the import; 0: none
  std::size_t tracks = 0;    ///< scalar tracks of the motion; 0 if nothing was stored
  std::size_t signs = 0;     ///< in the annotation after the import; 0 if nothing was stored
  std::size_t defects = 0;   ///< of the motion; 0 if nothing was stored
  std::string not_measured;  ///< why its phases were not measured; empty: they were, or there is only one half
  std::vector<Notice> notices;
};

/// Carries out a plan, atomically: an error leaves the recording as it was. Throws Error{conflict} if the entries that
/// the plan was made from have changed since, Error{io}, and what `progress` throws.
ImportReport apply(Database& database, const ImportPlan& plan, const Database::Progress& progress = {});

/// Imports one recording: plans it and applies the plan. Throws what the two throw.
ImportReport import_recording(Database& database, const ImportJob& job, const ImportOptions& options,
                              const Database::Progress& progress = {});

}  // namespace signweave
