#pragma once

#include <string>
#include <vector>

#include "app/calls/export_call.h"
#include "app/calls/synthesis_call.h"
#include "app/cli/command.h"

namespace signweave::cli {

/// Where `sign` and `edit` put what they made.
struct Delivery {
  std::vector<std::string> outputs;
  std::string score;  ///< file for the score; empty: none
  bool timings = false;
};

void add_reports(CLI::App& verb, Delivery& delivery);

/// Writes the files that were asked for, and what was asked to be told. `title` heads a contact sheet.
void deliver(const Synthesized& made, const calls::SynthesisChoices& choices, const Delivery& delivery,
             const std::string& title, calls::SharedCharacter character, Io& io);
/// Writes what `export` and `convert` have to write, and tells what was declared of it.
void deliver(const calls::Exported& made, const std::vector<std::string>& outputs, Io& io);
/// The character of a choice; null where none was asked for.
calls::SharedCharacter character_of(const std::string& file);

}  // namespace signweave::cli
