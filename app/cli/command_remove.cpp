#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "app/cli/command.h"
#include "app/cli/learning.h"
#include "signweave/database/database.h"

namespace signweave::cli {

Run remove(CLI::App& verb) {
  struct Options {
    std::string folder;
    std::string recording;
  };
  auto options = std::make_shared<Options>();
  verb.add_option("DB", options->folder, "the database")->required();
  verb.add_option("RECORDING", options->recording,
                  "name of the recording, or 'catalogue entry N' for one that check finds damaged")
      ->required();
  return [options](Io& io) {
    Database database(options->folder, kv::Access::read_write);
    database.remove(options->recording);
    learn(database, io);
    if (io.json)
      io.out << nlohmann::json{{"removed", options->recording}}.dump(2, ' ', false,
                                                                     nlohmann::json::error_handler_t::replace)
             << '\n';
  };
}

}  // namespace signweave::cli
