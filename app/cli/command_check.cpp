#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "app/cli/command.h"
#include "app/cli/progress.h"
#include "app/cli/table.h"
#include "signweave/database/database.h"

namespace signweave::cli {

Run check(CLI::App& verb) {
  auto folder = std::make_shared<std::string>();
  verb.add_option("DB", *folder, "the database")->required();
  return [folder](Io& io) {
    const Database database(*folder, kv::Access::read_only);
    std::vector<std::string> faults;
    {
      Progress progress(io, "checking");
      faults = database.check([&](double fraction) { progress.show(fraction); });
    }
    const std::size_t recordings = database.contents()->recordings.size();
    if (io.json) {
      io.out << nlohmann::json{{"recordings", recordings}, {"faults", faults}}.dump(
                    2, ' ', false, nlohmann::json::error_handler_t::replace)
             << '\n';
    } else if (faults.empty()) {
      io.out << counted(recordings, "recording") << ", no fault found\n";
    }
    for (const std::string& fault : faults) io.err << "signweave: " << fault << '\n';
    if (!faults.empty()) io.status = 1;
  };
}

}  // namespace signweave::cli
