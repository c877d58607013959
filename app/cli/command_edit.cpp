#include <CLI/CLI.hpp>
#include <memory>

#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/cli/delivery.h"
#include "signweave/calls/synthesis_call.h"

namespace signweave::cli {

Run edit(CLI::App& verb) {
  struct EditArguments {
    std::string folder;
    calls::EditCall call;
    Delivery delivery;
  };
  auto options = std::make_shared<EditArguments>();
  verb.add_option("DB", options->folder, "the database")->required();
  bind(verb, options->call, [&verb, options](std::string_view next) {
    if (next == "transition") add_outputs(verb, options->delivery.outputs);
  });
  verb.get_option("--replace")->excludes(verb.get_option("--swap"));
  for (const char* const other : {"--replace", "--swap"}) {
    verb.get_option("--replace-hand")->excludes(verb.get_option(other));
  }
  add_reports(verb, options->delivery);
  return [options](Io& io) {
    const calls::EditCall& call = options->call;
    // Errors in the arguments are reported before anything is opened.
    for (const std::string& text : call.replace) parse_replacement(text);
    if (!call.swap.empty()) parse_swap(call.swap);
    for (const std::string& text : call.replace_hand) parse_hand_replacement(text);
    if (call.replace.empty() && call.swap.empty() && call.replace_hand.empty()) {
      throw CLI::RequiredError("--replace, --swap or --replace-hand");
    }
    const Database database(options->folder, kv::Access::read_only);
    report_damage(database, io);
    check_signing_space(call.how.signing_space, options->delivery.outputs);
    const calls::SharedCharacter character = character_of(call.how.character);
    Synthesized made = calls::run(database, call);
    if (character) show_on(made, stance_of(database, signer_of(made)), *character);
    deliver(made, call.how, options->delivery, title_of(call), character, io);
  };
}

}  // namespace signweave::cli
