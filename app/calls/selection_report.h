#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "signweave/choose/synthesizer.h"

namespace signweave::calls {

/// Every candidate of every place, what it costs and why. Of a synthesis that was to explain itself.
nlohmann::json places_of(const Synthesized& made);

/// What was learned of joins, and how well it tells recorded neighbours from others.
nlohmann::json json_of(const JoinWeights& weights);
/// The same as one line: "learned from 92 pairs of recorded neighbours, …".
std::string describe(const JoinWeights& weights);

/// What captured movements taught of transitions.
nlohmann::json json_of(const ResidualModel& residuals);
/// The same as one line: "nothing learned from 12 movements of 2 recordings: too few to compare".
std::string describe(const ResidualModel& residuals);

}  // namespace signweave::calls
