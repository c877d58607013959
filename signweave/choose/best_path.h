#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "signweave/choose/join_cost.h"

namespace signweave {

/// All costs of one place, by candidate index. Costs are not negative.
struct PlaceCosts {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::shared_ptr<const JoinEnds> ends;  ///< at least one candidate
  std::vector<float> own;                ///< [candidate] cost independent of its neighbours
  /// [candidate of the previous place] cost added because this place follows; empty: none.
  std::vector<float> added_before;
  std::vector<float> made_before;  ///< [candidate] cost of a generated transition before it, in addition to the join
  std::vector<float> made_after;   ///< [candidate] the same after it
  /// [candidate] the candidate of the previous place that precedes it in its recording, so that the recorded transition
  /// is kept at no cost; kNone if there is none.
  std::vector<std::uint32_t> kept;
  /// [candidate of the previous place][candidate] join costs; empty: computed from the ends.
  std::vector<float> joins;

  std::size_t size() const noexcept { return own.size(); }
};

/// One candidate per place.
struct Path {
  std::vector<std::size_t> chosen;  ///< [place]
  double total = 0;
};

/// Cost of a transition from candidate `a` of a place to candidate `b` of the next.
float transition_cost(const PlaceCosts& before, std::size_t a, const PlaceCosts& place, std::size_t b,
                      const JoinScale& scale) noexcept;

/// Total cost of a path: own costs, transitions, and the generated transitions at the begin and end of the utterance.
double path_cost(std::span<const PlaceCosts> places, std::span<const std::size_t> chosen, const JoinScale& scale);

/// The path of least cost (Viterbi 1967). Of paths of equal cost, the one whose last candidates come first. Time is
/// linear in the places and at most quadratic in the candidates: previous candidates are tried in order of their path
/// cost, and only while they can still be best. Exact except for rounding.
Path best_path(std::span<const PlaceCosts> places, const JoinScale& scale);

/// The same choice while places arrive. A place is decided once `ahead` more are known, by the best path through them.
/// The time per place does not depend on the length of the utterance.
class PathAhead {
 public:
  /// `ahead` is at least 1.
  explicit PathAhead(JoinScale scale, std::size_t ahead = 3) : scale_(scale), ahead_(std::max<std::size_t>(ahead, 1)) {}

  /// Adds the next place. Returns the candidate of the place `ahead` before it, once there is one.
  std::optional<std::size_t> push(PlaceCosts place);
  /// Ends the utterance. Returns the candidates of the undecided places. The object can then be reused.
  std::vector<std::size_t> finish();

 private:
  struct Held {
    PlaceCosts costs;
    std::vector<float> transitions;  ///< [previous candidate][candidate]; the first has one row
  };
  std::vector<std::size_t> best(bool at_end) const;
  std::size_t decide(std::size_t chosen);
  std::vector<float> transitions_between(const PlaceCosts& before, const PlaceCosts& place);

  JoinScale scale_;
  std::size_t ahead_;
  std::deque<Held> held_;
  JoinLanes lanes_;
};

}  // namespace signweave
