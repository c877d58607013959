#include "signweave/choose/best_path.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>

namespace signweave {
namespace {

constexpr std::size_t kLanes = JoinEnds::kLanes;

float join_cost(const PlaceCosts& before, std::size_t a, const PlaceCosts& place, std::size_t b,
                const JoinScale& scale) noexcept {
  if (!place.joins.empty()) return place.joins[a * place.size() + b];
  return cost_of(join_terms(before.ends->end(a), place.ends->begin(b), scale.transition, scale.weights.speed_limit),
                 scale.weights.weights);
}

/// The cost of the best path to each candidate of a place, and its previous candidate.
struct Reached {
  std::vector<float> cost;          ///< minus `base`
  std::vector<std::uint32_t> from;  ///< candidate of the previous place
};

class Forward {
 public:
  explicit Forward(const JoinScale& scale) : scale_(scale) {}

  /// Advances one place. Costs are relative to the cheapest, which is accumulated in `base`, so they keep their
  /// precision for any number of places.
  void step(const PlaceCosts& before, const PlaceCosts& place, const std::vector<float>& cost, Reached& out) {
    const std::size_t count = before.size();
    leaving_.resize(count);
    made_.resize(count);
    for (std::size_t a = 0; a < count; ++a) {
      leaving_[a] = cost[a] + (place.added_before.empty() ? 0.0f : place.added_before[a]);
      made_[a] = leaving_[a] + before.made_after[a];
    }
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), 0u);
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return made_[a] != made_[b] ? made_[a] < made_[b] : a < b; });
    sorted_.assign((count + kLanes - 1) / kLanes * kLanes, std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < count; ++i) sorted_[i] = made_[order_[i]];
    if (place.joins.empty()) lanes_.place(*before.ends, order_, scale_);
    out.cost.resize(place.size());
    out.from.resize(place.size());
    for (std::size_t b = 0; b < place.size(); ++b) reach(place, b, out);
  }

 private:
  void reach(const PlaceCosts& place, std::size_t b, Reached& out) {
    float least = std::numeric_limits<float>::infinity();
    std::uint32_t from = PlaceCosts::kNone;
    const std::uint32_t kept = place.kept[b];
    if (kept != PlaceCosts::kNone) {
      least = leaving_[kept];
      from = kept;
    }
    const float to = place.made_before[b];
    std::array<float, kLanes> costs{};
    if (place.joins.empty()) lanes_.compare_with(place.ends->begin(b));
    for (std::size_t at = 0; at < order_.size(); at += kLanes) {
      if (sorted_[at] + to > least) break;  // true for all following candidates too, whatever their joins cost
      const std::size_t end = std::min(at + kLanes, order_.size());
      float here = 0;
      if (place.joins.empty()) {
        here = lanes_.costs(at / kLanes, std::span<const float, kLanes>(sorted_.data() + at, kLanes), to, costs);
      } else {
        for (std::size_t i = at; i < end; ++i) {
          costs[i - at] = sorted_[i] + to + place.joins[order_[i] * place.size() + b];
        }
      }
      if (here > least) continue;
      for (std::size_t i = at; i < end; ++i) {
        const std::uint32_t a = order_[i];
        if (a == kept) continue;
        const float cost = costs[i - at];
        if (cost < least || (cost == least && a < from)) {
          least = cost;
          from = a;
        }
      }
    }
    out.cost[b] = least + place.own[b];
    out.from[b] = from;
  }

  const JoinScale& scale_;
  std::vector<float> leaving_;  ///< [previous candidate] path cost to it
  std::vector<float> made_;     ///< the same including the cost of a generated transition after it
  std::vector<float> sorted_;   ///< the same in the order below, in whole blocks
  std::vector<std::uint32_t> order_;
  JoinLanes lanes_;
};

}  // namespace

float transition_cost(const PlaceCosts& before, std::size_t a, const PlaceCosts& place, std::size_t b,
                      const JoinScale& scale) noexcept {
  if (place.kept[b] == a) return 0;
  return before.made_after[a] + place.made_before[b] + join_cost(before, a, place, b, scale);
}

double path_cost(std::span<const PlaceCosts> places, std::span<const std::size_t> chosen, const JoinScale& scale) {
  double total = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const PlaceCosts& place = places[i];
    total += static_cast<double>(place.own[chosen[i]]);
    if (i == 0) total += static_cast<double>(place.made_before[chosen[i]]);
    if (i + 1 == places.size()) total += static_cast<double>(place.made_after[chosen[i]]);
    if (i == 0) continue;
    if (!place.added_before.empty()) total += static_cast<double>(place.added_before[chosen[i - 1]]);
    total += static_cast<double>(transition_cost(places[i - 1], chosen[i - 1], place, chosen[i], scale));
  }
  return total;
}

Path best_path(std::span<const PlaceCosts> places, const JoinScale& scale) {
  Path path;
  if (places.empty()) return path;
  std::vector<Reached> reached(places.size());
  Forward forward(scale);
  const auto settle = [&](std::vector<float>& costs) {
    const float least = *std::min_element(costs.begin(), costs.end());
    for (float& cost : costs) cost -= least;
    path.total += static_cast<double>(least);
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    const PlaceCosts& place = places[i];
    assert(place.size() > 0 && place.made_before.size() == place.size() && place.made_after.size() == place.size());
    if (i == 0) {
      for (std::size_t b = 0; b < place.size(); ++b) reached[0].cost.push_back(place.own[b] + place.made_before[b]);
    } else {
      forward.step(places[i - 1], place, reached[i - 1].cost, reached[i]);
    }
    if (i + 1 == places.size()) {
      for (std::size_t b = 0; b < place.size(); ++b) reached[i].cost[b] += place.made_after[b];
    }
    settle(reached[i].cost);
  }
  const std::vector<float>& last = reached.back().cost;
  std::size_t at = static_cast<std::size_t>(std::min_element(last.begin(), last.end()) - last.begin());
  path.chosen.resize(places.size());
  for (std::size_t i = places.size(); i-- > 0;) {
    path.chosen[i] = at;
    if (i > 0) at = reached[i].from[at];
  }
  return path;
}

std::optional<std::size_t> PathAhead::push(PlaceCosts place) {
  Held next{.costs = std::move(place), .transitions = {}};
  if (held_.empty()) {
    next.transitions = next.costs.made_before;  // from the begin of the utterance
  } else {
    const PlaceCosts& before = held_.back().costs;
    next.transitions = transitions_between(before, next.costs);
  }
  held_.push_back(std::move(next));
  if (held_.size() <= ahead_) return std::nullopt;
  return decide(best(false).front());
}

std::vector<float> PathAhead::transitions_between(const PlaceCosts& before, const PlaceCosts& place) {
  const std::size_t count = place.size();
  std::vector<float> transitions(before.size() * count);
  const bool given = !place.joins.empty();
  std::vector<float> made((before.size() + kLanes - 1) / kLanes * kLanes);
  std::copy(before.made_after.begin(), before.made_after.end(), made.begin());
  std::vector<std::uint32_t> order(before.size());
  std::iota(order.begin(), order.end(), 0u);
  if (!given) lanes_.place(*before.ends, order, scale_);
  std::array<float, kLanes> costs{};
  for (std::size_t b = 0; b < count; ++b) {
    if (!given) lanes_.compare_with(place.ends->begin(b));
    for (std::size_t a = 0; a < before.size(); ++a) {
      float& transition = transitions[a * count + b];
      if (given) {
        transition = transition_cost(before, a, place, b, scale_);
      } else {
        if (a % kLanes == 0) {
          lanes_.costs(a / kLanes, std::span<const float, kLanes>(made.data() + a, kLanes), place.made_before[b],
                       costs);
        }
        transition = place.kept[b] == a ? 0.0f : costs[a % kLanes];
      }
      if (!place.added_before.empty()) transition += place.added_before[a];
    }
  }
  return transitions;
}

std::vector<std::size_t> PathAhead::finish() {
  std::vector<std::size_t> rest = best(true);
  held_.clear();
  return rest;
}

std::vector<std::size_t> PathAhead::best(bool at_end) const {
  std::vector<std::size_t> chosen(held_.size());
  if (held_.empty()) return chosen;
  std::vector<std::vector<std::uint32_t>> from(held_.size());
  std::vector<float> cost;
  std::vector<float> next;
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const Held& held = held_[i];
    const std::size_t count = held.costs.size();
    from[i].assign(count, 0);
    next.assign(held.transitions.begin(), held.transitions.begin() + static_cast<std::ptrdiff_t>(count));
    if (i > 0) {
      std::fill(next.begin(), next.end(), std::numeric_limits<float>::infinity());
      for (std::size_t a = 0; a < cost.size(); ++a) {
        for (std::size_t b = 0; b < count; ++b) {
          const float there = cost[a] + held.transitions[a * count + b];
          if (there < next[b]) {
            next[b] = there;
            from[i][b] = static_cast<std::uint32_t>(a);
          }
        }
      }
    }
    for (std::size_t b = 0; b < count; ++b) next[b] += held.costs.own[b];
    if (at_end && i + 1 == held_.size()) {
      for (std::size_t b = 0; b < count; ++b) next[b] += held.costs.made_after[b];
    }
    std::swap(cost, next);
  }
  std::size_t at = static_cast<std::size_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
  for (std::size_t i = held_.size(); i-- > 0;) {
    chosen[i] = at;
    at = from[i][at];
  }
  return chosen;
}

std::size_t PathAhead::decide(std::size_t chosen) {
  held_.pop_front();
  if (!held_.empty()) {  // only paths through it count from now on
    Held& first = held_.front();
    const auto count = static_cast<std::ptrdiff_t>(first.costs.size());
    const auto row = first.transitions.begin() + static_cast<std::ptrdiff_t>(chosen) * count;
    first.transitions = std::vector<float>(row, row + count);
  }
  return chosen;
}

}  // namespace signweave
