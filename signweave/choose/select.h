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

/// The candidates of one place and the pause before it.
struct Choice {
  std::vector<Candidate> candidates;  ///< at least one
  Milliseconds pause_before{0};
  bool continues = false;  ///< its only candidate follows that of the place before in the recording, and stays there
};

/// The costs of one candidate of a place, given the choices of the neighbouring places.
struct CandidateCosts {
  TargetTerms target{};  ///< each term times its weight
  JoinTerms join{};      ///< of the join to the previous choice, each term times its weight
  /// Replacement cost if features of that join are unknown; if all are, it is computed from the rotations of all
  /// joints.
  float join_unknown = 0;
  bool kept = false;  ///< it follows the previous choice in the recording: the recorded transition is kept, at no cost
  float target_cost = 0;  ///< the sum of `target`
  float join_cost = 0;    ///< of `join` and `join_unknown`; 0 if `kept`
  float cost = 0;         ///< both, plus the join to the next choice
};

/// One selected candidate per place.
struct Selection {
  std::vector<std::size_t> chosen;  ///< [place] index into its candidates
  std::vector<double> join_costs;   ///< [place] cost of the join to the previous place; 0 for the first
  double total = 0;
  bool measured = false;  ///< false if each place has one candidate: nothing is chosen, and join costs are unknown
  JoinWeights weights;    ///< of the joins; the defaults if nothing was measured
  Seconds transition{0};  ///< the assumed duration of a transition
  std::vector<std::vector<CandidateCosts>> explained;  ///< [place][candidate]; empty unless requested
};

struct SelectOptions {
  Seconds transition{0.5};  ///< the assumed duration of a transition
  bool explain = false;     ///< report the costs of every candidate
};

/// Selects the candidates with the least sum of target and join costs (`best_path`). Signs that are neighbours in one
/// recording keep their recorded transition at no cost. Join costs use the stored features (features/join.h); if a side
/// has none, the mean rotation over all joints from the last stroke frame of one to the first of the other, which are
/// then read.
Selection select(const Snapshot& snapshot, std::span<const Choice> choices, const SelectOptions& options = {});

/// Computes the costs of one place after another. For a repeated gloss, everything that does not depend on its
/// neighbours is computed once. Used by one thread; must not outlive its snapshot.
class Selector {
 public:
  Selector(const Snapshot& snapshot, const SelectOptions& options);
  ~Selector();
  Selector(Selector&&) noexcept;
  Selector& operator=(Selector&&) noexcept;

  const JoinScale& scale() const noexcept;
  /// The costs of the place after that of the last call, for `best_path` and `PathAhead`.
  PlaceCosts next(const Choice& choice);
  /// The target costs of a candidate of the last call's place, each term times its weight, without `right`.
  TargetTerms target(std::size_t candidate) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// True if `b` directly follows `a` in the same recording, so that the recorded transition can be kept.
bool are_neighbours(const Contents& contents, const Candidate& a, const Candidate& b);

}  // namespace signweave
