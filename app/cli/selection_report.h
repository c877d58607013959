#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/cli/command.h"
#include "signweave/synthesis/synthesizer.h"

namespace signweave::cli {

/// Candidates and what they cost, place by place: of each place the cheapest few, and how many more there are; then the
/// weights.
void print_selection(const Synthesized& made, Io& io);

/// All of it.
nlohmann::json places_of(const Synthesized& made);

/// What was learned of joins, and how well it tells recorded neighbours from others.
nlohmann::json json_of(const JoinWeights& weights);
/// The same as one line: "learned from 92 pairs of recorded neighbours, …".
std::string describe(const JoinWeights& weights);

}  // namespace signweave::cli
