#include "signweave/calls/selection_report.h"

#include <fmt/format.h>

#include "signweave/calls/table.h"
#include "signweave/choose/target_cost.h"

namespace signweave::calls {

std::string describe(const JoinWeights& weights) {
  if (weights.pairs == 0) return "the defaults, because no two neighbours were measured";
  if (weights.wins <= weights.default_wins) {
    return fmt::format(
        "the defaults, by which recorded neighbours win {:.0f} % of {} with other tokens ({}); nothing learned from "
        "them does better",
        100 * weights.wins, counted(weights.comparisons, "comparison"), counted(weights.pairs, "pair"));
  }
  return fmt::format(
      "learned from {} of recorded neighbours, which win {:.0f} % of {} with other tokens ({}; {:.0f} % with the "
      "defaults)",
      counted(weights.pairs, "pair"), 100 * weights.wins, counted(weights.comparisons, "comparison"),
      weights.folds > 0 ? "cross-validated by recording" : "not cross-validated: one recording",
      100 * weights.default_wins);
}

std::string describe(const ResidualModel& residuals) {
  const std::string from = fmt::format("{} of {}", counted(residuals.movements, "captured movement"),
                                       counted(residuals.recordings, "recording"));
  if (residuals.folds == 0) return fmt::format("nothing learned from {}: too few to compare", from);
  const std::string compared = fmt::format(
      "the wrists' error is {:.3f} of that of kriging on average, {:.3f} in the median "
      "({} left out in turn)",
      residuals.mean_ratio, residuals.median_ratio, residuals.by_signer ? "signers" : "recordings");
  if (residuals.centres.empty()) return fmt::format("nothing learned from {}: {}", from, compared);
  return fmt::format("learned from {}: {}; transitions use it", from, compared);
}

std::vector<PlaceAnswer> places_of(const Synthesized& made) {
  std::vector<PlaceAnswer> places;
  for (std::size_t place = 0; place < made.choices.size(); ++place) {
    PlaceAnswer answer{
        .candidates = {}, .chosen = made.selection.chosen[place], .join_cost = made.selection.join_costs[place]};
    for (std::size_t i = 0; i < made.choices[place].candidates.size(); ++i) {
      const Candidate& candidate = made.choices[place].candidates[i];
      answer.candidates.push_back({.recording = made.contents->recordings[candidate.recording].name,
                                   .token = candidate.token,
                                   .frames = candidate.whole,
                                   .costs = made.selection.explained[place][i],
                                   .joined = place > 0});
    }
    places.push_back(std::move(answer));
  }
  return places;
}

}  // namespace signweave::calls
