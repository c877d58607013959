#include <CLI/CLI.hpp>
#include <memory>

#include "app/cli/command.h"
#include "app/cli/synthesis_options.h"

namespace signweave::cli {

Run edit(CLI::App& verb) {
  struct Options {
    SynthesisWords words;
    std::string recording;
    std::vector<std::string> replacements;
    std::string swap;
  };
  auto options = std::make_shared<Options>();
  verb.add_option("DB", options->words.folder, "the database")->required();
  verb.add_option("RECORDING", options->recording, "the recording to start from")->required();
  auto* replace =
      verb.add_option("--replace", options->replacements,
                      "GLOSS[#N]=GLOSS[#M]: the N-th of this recording by the M-th of the database (or the best); "
                      "may be given several times");
  auto* swap = verb.add_option("--swap", options->swap, "FROM..TO,FROM..TO: two runs of signs change places");
  replace->excludes(swap);
  add_synthesis_options(verb, options->words);
  return [options](Io& io) {
    Edit edit;
    for (const std::string& text : options->replacements) edit.replacements.push_back(parse_replacement(text));
    if (!options->swap.empty()) edit.swap = parse_swap(options->swap);
    if (edit.replacements.empty() && !edit.swap) throw CLI::RequiredError("--replace or --swap");
    const Database database(options->words.folder, kv::Access::read_only);
    report_damage(database, io);
    const Synthesized made = synthesize(database, options->recording, edit, synthesis_options(options->words));
    deliver(made, options->words, options->recording + ", edited", io);
  };
}

}  // namespace signweave::cli
