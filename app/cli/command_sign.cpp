#include <CLI/CLI.hpp>
#include <memory>

#include "app/calls/synthesis_call.h"
#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/cli/delivery.h"

namespace signweave::cli {

Run sign(CLI::App& verb) {
  struct SignArguments {
    std::string folder;
    calls::SignCall call;
    Delivery delivery;
  };
  auto options = std::make_shared<SignArguments>();
  verb.add_option("DB", options->folder, "the database")->required();
  bind(verb, options->call, [&verb, options](std::string_view next) {
    if (next == "transition") add_outputs(verb, options->delivery.outputs);
  });
  add_timings(verb, options->delivery);
  return [options](Io& io) {
    const std::string title = title_of(options->call);  // also tells what is wrong with the words
    const Database database(options->folder, kv::Access::read_only);
    report_damage(database, io);
    check_signing_space(options->call.how.signing_space, options->delivery.outputs);
    const calls::SharedCharacter character = character_of(options->call.how.character);
    Synthesized made = calls::run(database, options->call);
    if (character) show_on(made, stance_of(database, signer_of(made)), *character);
    deliver(made, options->call.how, options->delivery, title, character, io);
  };
}

}  // namespace signweave::cli
