#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "app/calls/info_call.h"
#include "app/calls/table.h"
#include "app/cli/command.h"
#include "app/cli/progress.h"
#include "signweave/database/check.h"

namespace signweave::cli {

Run check(CLI::App& verb) {
  auto folder = std::make_shared<std::string>();
  verb.add_option("DB", *folder, "the database")->required();
  return [folder](Io& io) {
    CheckResult result;
    {
      Progress progress(io, "checking");
      result = check_in_child(*folder, [&](double fraction) { progress.show(fraction); });
    }
    const std::vector<std::string>& faults = result.faults;
    if (io.json) {
      io.out << text_of(calls::json_of(result));
    } else if (faults.empty()) {
      io.out << counted(result.recordings, "recording") << ", no fault found\n";
    }
    for (const std::string& fault : faults) io.err << "signweave: " << fault << '\n';
    if (!faults.empty()) io.status = 1;
  };
}

}  // namespace signweave::cli
