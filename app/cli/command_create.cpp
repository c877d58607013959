#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "app/cli/command.h"
#include "signweave/core/text.h"
#include "signweave/database/database.h"

namespace signweave::cli {

Run create(CLI::App& verb) {
  struct Options {
    std::string folder;
    std::string engine = "lmdb";
    std::string mode = "by_frame";
  };
  auto options = std::make_shared<Options>();
  verb.add_option("DB", options->folder, "folder to make; must not exist or be empty")->required();
  verb.add_option("--engine", options->engine, "key-value engine")
      ->check(CLI::IsMember(kv::engines()))
      ->capture_default_str();
  verb.add_option("--access-mode", options->mode,
                  "how motions are cut: full, by_frame[:P], by_joint, by_joint_and_frame[:P]")
      ->check([](const std::string& text) {
        return parse_access_mode(text)
                   ? std::string()
                   : "'" + printable(text) + "' is no access mode: full, by_frame:P, by_joint or by_joint_and_frame:P";
      })
      ->capture_default_str();
  return [options](Io& io) {
    const AccessMode mode = *parse_access_mode(options->mode);
    Database::create(options->folder, {.engine = options->engine, .access_mode = mode});
    if (io.json) {
      io.out << nlohmann::json{{"database", options->folder},
                               {"engine", options->engine},
                               {"access_mode", to_string(mode)}}
                    .dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
             << '\n';
    }
  };
}

}  // namespace signweave::cli
