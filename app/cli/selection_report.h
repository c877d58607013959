#pragma once

#include "app/calls/selection_report.h"
#include "app/cli/command.h"

namespace signweave::cli {

/// Candidates and what they cost, place by place: of each place the cheapest few, and how many more there are; then the
/// weights.
void print_selection(const Synthesized& made, Io& io);

}  // namespace signweave::cli
