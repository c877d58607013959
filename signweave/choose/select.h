#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "signweave/choose/best_path.h"
#include "signweave/choose/candidate.h"
#include "signweave/choose/target_cost.h"
#include "signweave/database/database.h"

namespace signweave {

/// The candidates of one place and what joins it to the place before.
struct Choice {
  std::vector<Candidate> candidates;  ///< at least one
  Milliseconds pause_before{0};
};

/// What one candidate of a place costs among those that were chosen beside it.
struct CandidateCosts {
  TargetTerms target{};  ///< each term times its weight
  JoinTerms join{};      ///< of the join to the one chosen before, each term times its weight
  /// Where nothing or not all is known of that join: what is taken instead, from the rotations of all joints where
  /// nothing is known.
  float join_unknown = 0;
  bool kept = false;      ///< it was recorded after the one chosen before: its recorded transition is kept, at no cost
  float target_cost = 0;  ///< the sum of `target`
  float join_cost = 0;    ///< of `join` and `join_unknown`; 0 where it is kept
  float cost = 0;         ///< both, and the join to the one chosen after
};

/// One selected candidate per place.
struct Selection {
  std::vector<std::size_t> chosen;  ///< [place] index into its candidates
  std::vector<double> join_costs;   ///< [place] cost of the join to the place before; 0 for the first
  double total = 0;
  bool measured = false;  ///< false where each place has one candidate: nothing is chosen, and no join cost is known
  JoinWeights weights;    ///< of the joins; the defaults where nothing was measured
  Seconds transition{0};  ///< the time that a transition was taken to have
  std::vector<std::vector<CandidateCosts>> explained;  ///< [place][candidate]; empty unless asked for
};

struct SelectOptions {
  Seconds transition{0.5};  ///< the time that a transition is given
  bool explain = false;     ///< tell what every candidate costs
};

/// The candidates whose sum of target and join costs is least (`best_path`). Signs that were neighbours in one
/// recording keep their recorded transition, which costs nothing. Joins are judged by the stored features
/// (features/join.h); where nothing is known on one side, by the mean rotation over all joints from the last stroke
/// frame of one to the first of the other, which are read then.
Selection select(const Snapshot& snapshot, std::span<const Choice> choices, const SelectOptions& options = {});

/// What is looked at for one place after another: of a gloss that comes again, everything but what stands beside it is
/// worked out once. Belongs to one thread and lives no longer than its snapshot.
class Selector {
 public:
  Selector(const Snapshot& snapshot, const SelectOptions& options);
  ~Selector();
  Selector(Selector&&) noexcept;
  Selector& operator=(Selector&&) noexcept;

  const JoinScale& scale() const noexcept;
  /// The costs of the place that follows the one of the last call: for `best_path` and `PathAhead`.
  PlaceCosts next(const Choice& choice);
  /// What a candidate of the place of the last call costs by itself, each term times its weight, `right` left out.
  TargetTerms target(std::size_t candidate) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// True where `b` went on from `a` in the same recording, so that the recorded transition can be kept.
bool are_neighbours(const Contents& contents, const Candidate& a, const Candidate& b);

}  // namespace signweave
