#include <CLI/CLI.hpp>
#include <memory>

#include "app/cli/command.h"
#include "app/cli/synthesis_options.h"

namespace signweave::cli {

Run sign(CLI::App& verb) {
  struct Options {
    SynthesisWords words;
    std::string utterance;
  };
  auto options = std::make_shared<Options>();
  verb.add_option("DB", options->words.folder, "the database")->required();
  verb.add_option(
          "UTTERANCE", options->utterance,
          "glosses separated by blanks; \"LE MANS\" quoted, MATIN#3 one token, \"NAME\"@1200..3400 a piece of a "
          "recording, , and . pauses")
      ->required();
  add_synthesis_options(verb, options->words);
  return [options](Io& io) {
    const Utterance utterance = parse_utterance(options->utterance);
    const Database database(options->words.folder, kv::Access::read_only);
    report_damage(database, io);
    const Synthesized made = synthesize(database, utterance, synthesis_options(options->words));
    deliver(made, options->words, to_string(utterance), io);
  };
}

}  // namespace signweave::cli
