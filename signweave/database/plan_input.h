#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/database/database.h"
#include "signweave/database/import_options.h"
#include "signweave/database/pairing.h"
#include "signweave/database/recording.h"

/// Internal to `database`: the input that the steps of plan_import share.
namespace signweave {

/// Checksums of a job's files. 0: no such file.
struct JobFingerprints {
  std::uint64_t motion = 0;
  std::uint64_t annotation = 0;
  std::uint64_t face = 0;
};

/// The input of the plan of one import. The referenced objects must outlive it.
struct PlanInput {
  const Database& database;
  const ImportJob& job;
  const ImportOptions& options;
  const JobFingerprints& fingerprints;
  const RecordingInfo* known = nullptr;  ///< the recording as it is stored; null: it is not

  bool motion_known() const noexcept { return known != nullptr && known->motion.has_value(); }
  bool document_known() const noexcept { return known != nullptr && known->document != 0; }
  /// The name under which the recording is stored, or will be.
  const std::string& name() const noexcept { return known != nullptr ? known->name : job.name; }
};

/// Adds the stored notices about one file of a recording, for a half that is kept. Notices about the recording itself
/// are made again.
void keep_notices(const RecordingInfo& known, const std::string& file, std::vector<Notice>& notices);

}  // namespace signweave
