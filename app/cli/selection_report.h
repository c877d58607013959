#pragma once

#include "app/cli/command.h"
#include "signweave/calls/selection_report.h"

namespace signweave::cli {

/// Prints candidates and their costs, place by place: the cheapest few of each place, and how many more there are; then
/// the weights.
void print_selection(const Synthesized& made, Io& io);

}  // namespace signweave::cli
