#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "signweave/database/database.h"
#include "signweave/synthesis/candidate.h"

namespace signweave {

/// The candidates of one place and what joins it to the place before.
struct Choice {
  std::vector<Candidate> candidates;  ///< at least one
  Milliseconds pause_before{0};
};

/// One selected candidate per place.
struct Selection {
  std::vector<std::size_t> chosen;  ///< [place] index into its candidates
  std::vector<double> join_costs;   ///< [place] cost of the join to the place before; 0 for the first
  double total = 0;
  bool measured = false;  ///< false where each place has one candidate: nothing is chosen, and no join cost is known
};

/// The candidates whose sum of target and join costs is least (Viterbi). The join cost of two signs that were
/// neighbours in one recording is 0; else it is the mean rotation, in radians over all joints, from the last stroke
/// frame of one to the first of the other. Ties go to the earlier token. Reads two frames a candidate.
Selection select(const Snapshot& snapshot, std::span<const Choice> choices);

/// True where `b` went on from `a` in the same recording, so that the recorded transition can be kept.
bool are_neighbours(const Contents& contents, const Candidate& a, const Candidate& b);

}  // namespace signweave
