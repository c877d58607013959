#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/wire/text.h"
#include "signweave/calls/change_calls.h"

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
    const calls::Removed removed = calls::run(database, options->call);
    learn(database, listener_of(io));
    if (io.json) io.out << text_of(answer_json(removed));
  };
}

}  // namespace signweave::cli
