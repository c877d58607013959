#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "app/cli/command.h"
#include "app/cli/learning.h"
#include "app/cli/progress.h"
#include "app/cli/storage_options.h"
#include "app/cli/table.h"
#include "signweave/database/database.h"

namespace signweave::cli {

Run relayout(CLI::App& verb) {
  struct Options {
    std::string folder;
    std::string mode;
    std::optional<double> compact;  ///< millimetres
    std::vector<std::string> recordings;
  };
  auto options = std::make_shared<Options>();
  verb.add_option("DB", options->folder, "the database")->required();
  add_access_mode(verb, options->mode);
  add_compact(verb, options->compact);
  verb.add_option("RECORDING", options->recordings,
                  "recordings to store anew; without any, all of them and those that are imported later");
  return [options](Io& io) {
    if (options->mode.empty() && !options->compact) {
      throw CLI::ValidationError("what is to be changed? give --access-mode, --compact or both");
    }
    Storage storage;
    if (!options->mode.empty()) storage.mode = parse_access_mode(options->mode);
    if (options->compact) storage.tolerance = static_cast<float>(*options->compact / 1e3);
    Database database(options->folder, kv::Access::read_write);
    std::vector<std::string> names = options->recordings;
    const std::size_t names_given = names.size();
    if (names.empty()) {
      report_damage(database, io);
      for (const RecordingInfo& info : database.contents()->recordings) names.push_back(info.name);
    } else {
      for (const std::string& name : names) database.contents()->at(name);  // a wrong name changes nothing
    }
    // What was rounded stays so; for the whole database 0 is about those to come.
    Storage stored = storage;
    if (names_given == 0 && storage.tolerance == 0.0f) stored.tolerance.reset();
    std::vector<std::string> changed;
    {
      Progress progress(io, "storing anew");
      for (std::size_t i = 0; i < names.size(); ++i) {
        const auto show = [&](double fraction) {
          progress.show((static_cast<double>(i) + fraction) / static_cast<double>(names.size()));
        };
        try {
          const bool stored_anew = database.relayout(names[i], stored, show);
          if (database.measure(names[i]) || stored_anew) changed.push_back(names[i]);
        } catch (const Error& error) {  // the others go on
          io.err << "signweave: " << one_line(names[i]) << ": " << one_line(error.what()) << '\n';
          io.status = 1;
        }
      }
    }
    if (names_given == 0 && io.status == 0) database.set_storage(storage);
    learn(database, io);
    if (io.json) {
      io.out << nlohmann::json{{"recordings", names.size()}, {"changed", changed}}.dump(
                    2, ' ', false, nlohmann::json::error_handler_t::replace)
             << '\n';
      return;
    }
    io.out << fmt::format("{} of {} stored anew\n", changed.size(), counted(names.size(), "recording"));
  };
}

}  // namespace signweave::cli
