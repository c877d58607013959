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

/// What choosing at one place depends on, all of it by numbers. Costs are not negative.
struct PlaceCosts {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::shared_ptr<const JoinEnds> ends;  ///< at least one candidate
  std::vector<float> own;                ///< [candidate] whatever stands beside it
  /// [candidate of the place before] what is added to it for being followed by this place; empty: nothing.
  std::vector<float> added_before;
  std::vector<float> made_before;  ///< [candidate] what a made transition before it costs besides its join
  std::vector<float> made_after;   ///< [candidate] the same after it
  /// [candidate] the candidate of the place before that it goes on from in its recording, so that the recorded
  /// transition is kept and costs nothing; kNone where there is none.
  std::vector<std::uint32_t> kept;
  /// [candidate of the place before][candidate] what joins cost; empty: it follows from the ends. Not both.
  std::vector<float> joins;

  std::size_t size() const noexcept { return own.size(); }
};

/// One candidate a place.
struct Path {
  std::vector<std::size_t> chosen;  ///< [place]
  double total = 0;
};

/// What a transition from candidate `a` of a place to candidate `b` of the next costs.
float transition_cost(const PlaceCosts& before, std::size_t a, const PlaceCosts& place, std::size_t b,
                      const JoinScale& scale) noexcept;

/// The whole cost of a path: own costs, transitions, and what begin and end of the utterance cost as made transitions.
double path_cost(std::span<const PlaceCosts> places, std::span<const std::size_t> chosen, const JoinScale& scale);

/// The path that costs least (Viterbi 1967). Of paths that cost the same, the one whose last candidates come first.
/// Its time grows with the number of places and, at most, the square of the candidates: of the candidates before, in
/// the order of what leads to them, only those are looked at that can still be best. Exact but for rounding.
Path best_path(std::span<const PlaceCosts> places, const JoinScale& scale);

/// The same choice while places arrive: a place is decided once `ahead` more are known, by the best path through those.
/// A place costs the same time in an utterance of any length.
class PathAhead {
 public:
  /// `ahead` of at least 1.
  explicit PathAhead(JoinScale scale, std::size_t ahead = 3) : scale_(scale), ahead_(std::max<std::size_t>(ahead, 1)) {}

  /// Tells the next place. The candidate of the place `ahead` before it, once there is one.
  std::optional<std::size_t> push(PlaceCosts place);
  /// No place follows: the candidates of those not yet decided. It can then begin anew.
  std::vector<std::size_t> finish();

 private:
  struct Held {
    PlaceCosts costs;
    std::vector<float>
        transitions;  ///< [candidate before][candidate]; of the first held, from what was decided: one row
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
