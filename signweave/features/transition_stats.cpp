#include "signweave/features/transition_stats.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

#include "signweave/core/text.h"

namespace signweave {
namespace {

template <typename DurationOf>
PartStats part_of(std::span<const RecordedTransition> transitions, const DurationOf& duration_of,
                  std::array<HandTravel, 2> TransitionMotion::*part) {
  PartStats stats;
  std::vector<double> durations;
  for (const RecordedTransition& one : transitions) durations.push_back(count_of(duration_of(one.transition)));
  stats.duration = distribution_of(durations);
  for (std::size_t side = 0; side < stats.hands.size(); ++side) {
    std::vector<double> displacements;
    std::vector<double> paths;
    std::vector<double> speeds;
    for (std::size_t i = 0; i < transitions.size(); ++i) {
      if (!transitions[i].motion) continue;
      const HandTravel& travel = ((*transitions[i].motion).*part)[side];
      if (!travel.known) continue;
      displacements.push_back(travel.displacement);
      paths.push_back(travel.path);
      if (durations[i] > 0) speeds.push_back(1000 * travel.path / durations[i]);
    }
    stats.hands[side] = {distribution_of(displacements), distribution_of(paths), distribution_of(speeds)};
  }
  return stats;
}

}  // namespace

std::vector<AnnotatedTransition> transitions_in(std::span<const Sign> signs) {
  std::vector<std::size_t> order(signs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return signs[a].tier != signs[b].tier ? signs[a].tier < signs[b].tier : signs[a].span.begin < signs[b].span.begin;
  });
  std::vector<AnnotatedTransition> result;
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

TransitionStats summarize(std::span<const AnnotatedTransition> transitions) {
  TransitionStats stats;
  stats.inferred =
      std::all_of(transitions.begin(), transitions.end(), [](const AnnotatedTransition& t) { return t.inferred; });
  std::vector<double> durations;
  double retraction = 0;
  double preparation = 0;
  for (const AnnotatedTransition& transition : transitions) {
    if (transition.inferred != stats.inferred) continue;
    durations.push_back(count_of(transition.span.duration()));
    retraction += count_of(transition.retraction);
    preparation += count_of(transition.preparation);
  }
  const Distribution of = distribution_of(durations);
  stats.count = of.count;
  if (of.count == 0) return stats;
  const auto rounded = [](double value) { return Milliseconds(std::llround(value)); };
  stats.mean = rounded(of.mean);
  stats.deviation = rounded(of.deviation);
  stats.median = rounded(of.median());
  stats.percentile_10 = rounded(of.quantiles[1]);
  stats.percentile_90 = rounded(of.quantiles[5]);
  stats.mean_retraction = rounded(retraction / static_cast<double>(of.count));
  stats.mean_preparation = rounded(preparation / static_cast<double>(of.count));
  return stats;
}

std::vector<RecordedTransition> recorded_transitions(const std::string& recording, std::span<const Sign> signs,
                                                     const MotionOf& motion_of) {
  std::vector<RecordedTransition> result;
  for (const AnnotatedTransition& transition : transitions_in(signs)) {
    const Sign& from = signs[transition.from];
    const Sign& to = signs[transition.to];
    result.push_back(
        {recording, from.gloss, to.gloss, transition, motion_of ? motion_of(from, to, transition) : std::nullopt});
  }
  std::stable_sort(result.begin(), result.end(), [](const RecordedTransition& a, const RecordedTransition& b) {
    return a.transition.span.begin < b.transition.span.begin;
  });
  return result;
}

std::vector<RecordedTransition> counted_transitions(std::span<const RecordedTransition> transitions) {
  const bool inferred = std::all_of(transitions.begin(), transitions.end(),
                                    [](const RecordedTransition& one) { return one.transition.inferred; });
  std::vector<RecordedTransition> result;
  std::copy_if(transitions.begin(), transitions.end(), std::back_inserter(result),
               [&](const RecordedTransition& one) { return one.transition.inferred == inferred; });
  return result;
}

TransitionSummary describe(std::span<const RecordedTransition> transitions) {
  const std::vector<RecordedTransition> of = counted_transitions(transitions);
  TransitionSummary summary;
  summary.inferred = !of.empty() && of.front().transition.inferred;
  summary.whole = part_of(
      of, [](const AnnotatedTransition& t) { return t.span.duration(); }, &TransitionMotion::whole);
  if (summary.inferred) return summary;
  summary.retraction = part_of(
      of, [](const AnnotatedTransition& t) { return t.retraction; }, &TransitionMotion::retraction);
  summary.preparation = part_of(
      of, [](const AnnotatedTransition& t) { return t.preparation; }, &TransitionMotion::preparation);
  return summary;
}

std::vector<PairStats> by_pair(std::span<const RecordedTransition> transitions) {
  std::map<std::pair<std::string, std::string>, std::vector<RecordedTransition>> groups;
  for (const RecordedTransition& one : transitions) {
    groups[{match_form(one.from), match_form(one.to)}].push_back(one);
  }
  std::vector<PairStats> result;
  for (const auto& [names, group] : groups) {
    result.push_back({group.front().from, group.front().to, describe(group)});
  }
  std::stable_sort(result.begin(), result.end(), [](const PairStats& a, const PairStats& b) {
    return a.summary.whole.duration.count > b.summary.whole.duration.count;
  });
  return result;
}

}  // namespace signweave
