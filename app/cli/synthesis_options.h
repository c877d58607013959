#pragma once

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "signweave/synthesis/synthesizer.h"

namespace signweave::cli {

/// The options that `sign` and `edit` share.
struct SynthesisWords {
  std::string folder;
  std::vector<std::string> outputs;
  bool signing_space = false;
  std::string method;
  std::string duration = "fitted";
  double tempo = 1;
  std::string rate;
  std::string align = "auto";
  bool explain = false;
  bool timings = false;
};

void add_synthesis_options(CLI::App& verb, SynthesisWords& words);
SynthesisOptions synthesis_options(const SynthesisWords& words);

/// Writes the files that were asked for, and what was asked to be told. `title` heads a contact sheet.
void deliver(const Synthesized& made, const SynthesisWords& words, const std::string& title, Io& io);

}  // namespace signweave::cli
