#pragma once

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "signweave/calls/export_call.h"
#include "signweave/calls/synthesis_call.h"

namespace signweave::cli {

/// Where `sign` and `edit` write their results.
struct Delivery {
  std::vector<std::string> outputs;
  std::string score;  ///< file for the score; empty: not written
  bool timings = false;
};

void add_reports(CLI::App& verb, Delivery& delivery);

/// Writes the requested files, and prints the requested reports. `title` is the heading of a contact sheet.
void deliver(const Synthesized& made, const calls::SynthesisChoices& choices, const Delivery& delivery,
             const std::string& title, calls::SharedCharacter character, Io& io);
/// Writes the outputs of `export` and `convert`, and reports what was declared about them.
void deliver(const calls::Exported& made, const std::vector<std::string>& outputs, Io& io);
/// Reads the chosen character; null if `file` is empty.
calls::SharedCharacter character_of(const std::string& file);

}  // namespace signweave::cli
