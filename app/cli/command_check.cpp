#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "app/cli/command.h"
#include "app/cli/progress.h"
#include "app/wire/text.h"
#include "signweave/backup/backup.h"
#include "signweave/calls/info_call.h"
#include "signweave/calls/table.h"
#include "signweave/database/check.h"

namespace signweave::cli {

namespace {

/// Reports as for a database: the recordings of the newest state.
CheckResult check_of_backup(const std::string& folder, const BackupProgress& progress) {
  CheckResult result;
  for (const BackupState& state : backup_states(folder))
    result.recordings = static_cast<std::uint32_t>(state.recordings);
  result.faults = check_backup(folder, progress);
  return result;
}

}  // namespace

Run check(CLI::App& verb) {
  auto folder = std::make_shared<std::string>();
  verb.add_option("DB", *folder, "the database, or a backup of one")->required();
  return [folder](Io& io) {
    CheckResult result;
    {
      Progress progress(io, "checking", "stopped before everything was checked");
      const auto show = [&](double fraction) { progress.show(fraction); };
      if (is_backup(*folder)) {
        result = check_of_backup(*folder, show);
      } else {
        result = check_in_child(*folder, show);
      }
    }
    const std::vector<std::string>& faults = result.faults;
    if (io.json) {
      io.out << text_of(answer_json<nlohmann::json>(result));
    } else if (faults.empty()) {
      io.out << counted(result.recordings, "recording") << ", no fault found\n";
    }
    for (const std::string& fault : faults) io.err << "signweave: " << fault << '\n';
    if (!faults.empty()) io.status = 1;
  };
}

}  // namespace signweave::cli
