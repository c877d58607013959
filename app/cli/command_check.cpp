#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "app/cli/command.h"
#include "app/cli/progress.h"
#include "app/cli/table.h"
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
      io.out << nlohmann::json{{"recordings", result.recordings}, {"faults", faults}}.dump(
                    2, ' ', false, nlohmann::json::error_handler_t::replace)
             << '\n';
    } else if (faults.empty()) {
      io.out << counted(result.recordings, "recording") << ", no fault found\n";
    }
    for (const std::string& fault : faults) io.err << "signweave: " << fault << '\n';
    if (!faults.empty()) io.status = 1;
  };
}

}  // namespace signweave::cli
