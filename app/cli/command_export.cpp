#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "app/calls/export_call.h"
#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/cli/delivery.h"

namespace signweave::cli {

Run export_recording(CLI::App& verb) {
  struct ExportArguments {
    std::string folder;
    std::vector<std::string> outputs;
    calls::ExportCall call;
  };
  auto options = std::make_shared<ExportArguments>();
  verb.add_option("DB", options->folder, "the database")->required();
  bind(verb, options->call, [&verb, options](std::string_view next) {
    if (next == "from") add_outputs(verb, options->outputs);
  });
  return [options](Io& io) {
    check_signing_space(options->call.signing_space, options->outputs);
    const Database database(options->folder, kv::Access::read_only);
    report_damage(database, io);
    const calls::SharedCharacter character = character_of(options->call.character);
    calls::Exported made = calls::run(database, options->call, options->outputs);
    if (character) show_on(made, stance_of(database, made.info), character);
    deliver(made, options->outputs, io);
  };
}

}  // namespace signweave::cli
