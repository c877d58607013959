#include "app/calls/selection_report.h"

#include <fmt/format.h>

#include "app/calls/table.h"
#include "signweave/choose/target_cost.h"

namespace signweave::calls {

using nlohmann::json;

std::string describe(const JoinWeights& weights) {
  if (weights.pairs == 0) return "the defaults, for no two neighbours were measured";
  if (weights.wins <= weights.default_wins) {
    return fmt::format(
        "the defaults, by which recorded neighbours win {:.0f} % of {} with other tokens ({}); nothing learned from "
        "them "
        "does better",
        100 * weights.wins, counted(weights.comparisons, "comparison"), counted(weights.pairs, "pair"));
  }
  return fmt::format(
      "learned from {} of recorded neighbours, which win {:.0f} % of {} with other tokens ({}; {:.0f} % with the "
      "defaults)",
      counted(weights.pairs, "pair"), 100 * weights.wins, counted(weights.comparisons, "comparison"),
      weights.folds > 0 ? "cross-validated by recording" : "not cross-validated: one recording",
      100 * weights.default_wins);
}

json json_of(const JoinWeights& weights) {
  json terms;
  for (std::size_t i = 0; i < kJoinTerms; ++i)
    terms[std::string(name_of(static_cast<JoinTerm>(i)))] = weights.weights[i];
  json target;
  for (std::size_t i = 0; i < kTargetTerms; ++i) {
    target[std::string(name_of(static_cast<TargetTerm>(i)))] = kTargetWeights[i];
  }
  return {{"join", std::move(terms)}, {"target", std::move(target)},         {"speed_limit", weights.speed_limit},
          {"pairs", weights.pairs},   {"comparisons", weights.comparisons},  {"folds", weights.folds},
          {"wins", weights.wins},     {"default_wins", weights.default_wins}};
}

std::string describe(const ResidualModel& residuals) {
  const std::string from = fmt::format("{} of {}", counted(residuals.movements, "captured movement"),
                                       counted(residuals.recordings, "recording"));
  if (residuals.folds == 0) return fmt::format("nothing learned from {}: too few to compare", from);
  const std::string compared = fmt::format(
      "wrists are off by {:.3f} of what the likeliest way is in the mean, {:.3f} in the median "
      "({} left out in turn)",
      residuals.mean_ratio, residuals.median_ratio, residuals.by_signer ? "signers" : "recordings");
  if (residuals.centres.empty()) return fmt::format("nothing learned from {}: {}", from, compared);
  return fmt::format("learned from {}: {}; transitions go by it", from, compared);
}

json json_of(const ResidualModel& residuals) {
  return {{"learned", !residuals.centres.empty()},
          {"movements", residuals.movements},
          {"recordings", residuals.recordings},
          {"folds", residuals.folds},
          {"left_out_by", residuals.by_signer ? "signer" : "recording"},
          {"mean_ratio", residuals.mean_ratio},
          {"median_ratio", residuals.median_ratio}};
}

json places_of(const Synthesized& made) {
  json places = json::array();
  for (std::size_t place = 0; place < made.choices.size(); ++place) {
    json candidates = json::array();
    for (std::size_t i = 0; i < made.choices[place].candidates.size(); ++i) {
      const Candidate& candidate = made.choices[place].candidates[i];
      const CandidateCosts& costs = made.selection.explained[place][i];
      json target;
      for (std::size_t k = 0; k < kTargetTerms; ++k) {
        target[std::string(name_of(static_cast<TargetTerm>(k)))] = costs.target[k];
      }
      json one = {{"recording", made.contents->recordings[candidate.recording].name},
                  {"token", candidate.token},
                  {"frames", {{"begin", candidate.whole.begin}, {"end", candidate.whole.end}}},
                  {"cost", costs.cost},
                  {"target_cost", costs.target_cost},
                  {"target", std::move(target)}};
      if (place > 0) {
        json join;
        for (std::size_t k = 0; k < kJoinTerms; ++k) {
          join[std::string(name_of(static_cast<JoinTerm>(k)))] = costs.join[k];
        }
        join["unknown"] = costs.join_unknown;
        one["kept"] = costs.kept;
        one["join_cost"] = costs.join_cost;
        one["join"] = std::move(join);
      }
      candidates.push_back(std::move(one));
    }
    places.push_back({{"candidates", std::move(candidates)},
                      {"chosen", made.selection.chosen[place]},
                      {"join_cost", made.selection.join_costs[place]}});
  }
  return places;
}

}  // namespace signweave::calls
