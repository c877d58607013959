#include "signweave/features/transition_stats.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace signweave {

std::vector<Transition> transitions_in(std::span<const Sign> signs) {
  std::vector<std::size_t> order(signs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return signs[a].tier != signs[b].tier ? signs[a].tier < signs[b].tier : signs[a].span.begin < signs[b].span.begin;
  });
  std::vector<Transition> result;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const Sign& from = signs[order[i - 1]];
    const Sign& to = signs[order[i]];
    const bool inferred = from.inferred || to.inferred;
    if (from.tier != to.tier || to.span.begin - from.span.end > (inferred ? kRest : kMeeting)) continue;
    if (inferred && to.span.begin - from.span.end <= kTouching) continue;
    const auto before = from.stroke_span();
    const auto after = to.stroke_span();
    if (!before || !after || after->begin < before->end) continue;
    result.push_back({.from = order[i - 1],
                      .to = order[i],
                      .span = {before->end, after->begin},
                      .retraction = from.retraction_span().duration(),
                      .preparation = to.preparation_span().duration(),
                      .inferred = inferred});
  }
  return result;
}

TransitionStats summarize(std::span<const Transition> transitions) {
  TransitionStats stats;
  stats.inferred = std::all_of(transitions.begin(), transitions.end(), [](const Transition& t) { return t.inferred; });
  std::vector<double> durations;
  double retraction = 0;
  double preparation = 0;
  for (const Transition& transition : transitions) {
    if (transition.inferred != stats.inferred) continue;
    durations.push_back(static_cast<double>(transition.span.duration().count()));
    retraction += static_cast<double>(transition.retraction.count());
    preparation += static_cast<double>(transition.preparation.count());
  }
  stats.count = durations.size();
  if (durations.empty()) return stats;
  std::sort(durations.begin(), durations.end());
  const auto count = static_cast<double>(durations.size());
  const double mean = std::accumulate(durations.begin(), durations.end(), 0.0) / count;
  double squares = 0;
  for (const double duration : durations) squares += (duration - mean) * (duration - mean);
  const auto rounded = [](double value) { return Milliseconds(std::llround(value)); };
  const auto quantile = [&](double q) {  // linear between the two nearest ranks
    const double at = q * (count - 1.0);
    const auto low = static_cast<std::size_t>(at);
    const std::size_t high = std::min(low + 1, durations.size() - 1);
    return rounded(durations[low] + (at - static_cast<double>(low)) * (durations[high] - durations[low]));
  };
  stats.mean = rounded(mean);
  stats.deviation = rounded(std::sqrt(squares / count));
  stats.median = quantile(0.5);
  stats.percentile_10 = quantile(0.1);
  stats.percentile_90 = quantile(0.9);
  stats.mean_retraction = rounded(retraction / count);
  stats.mean_preparation = rounded(preparation / count);
  return stats;
}

}  // namespace signweave
