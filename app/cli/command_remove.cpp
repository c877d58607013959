#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "app/calls/change_calls.h"
#include "app/cli/bind.h"
#include "app/cli/command.h"

namespace signweave::cli {

Run remove(CLI::App& verb) {
  struct RemoveArguments {
    std::string folder;
    calls::RemoveCall call;
  };
  auto options = std::make_shared<RemoveArguments>();
  verb.add_option("DB", options->folder, "the database")->required();
  bind(verb, options->call);
  return [options](Io& io) {
    Database database(options->folder, kv::Access::read_write);
    database.announce("signweave remove");
    const nlohmann::json report = calls::run(database, options->call);
    learn(database, listener_of(io));
    if (io.json) io.out << text_of(report);
  };
}

}  // namespace signweave::cli
