#include "signweave/synthesis/durations.h"

#include <algorithm>

#include "signweave/core/error.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {
namespace {

bool is_stroke(const Phase& phase) {
  return phase.kind == PhaseKind::stroke;
}

/// The annotated transitions of one recording.
void add_transitions(const Database& database, const Contents& contents, std::uint32_t recording,
                     std::vector<TimedTransition>& out) {
  const std::vector<Sign> signs = signs_of(contents.segments, recording);
  std::vector<Transition> transitions = transitions_in(signs);
  std::erase_if(transitions, [](const Transition& one) { return one.inferred; });
  if (transitions.empty()) return;
  const RecordingFeatures features = database.features(contents.recordings[recording].name);
  const auto places = phase_places_of(contents.segments, recording);
  if (!features.why_not.empty() || places.size() != signs.size()) return;
  for (const Transition& one : transitions) {
    const std::vector<Phase>& from = signs[one.from].phases;
    const std::vector<Phase>& to = signs[one.to].phases;
    const auto last = std::ranges::find_if(from.rbegin(), from.rend(), is_stroke);
    const auto first = std::ranges::find_if(to, is_stroke);
    if (last == from.rend() || first == to.end()) continue;
    const std::size_t before = places[one.from][static_cast<std::size_t>(from.rend() - last) - 1];
    const std::size_t after = places[one.to][static_cast<std::size_t>(first - to.begin())];
    if (std::max(before, after) >= features.phases.size()) continue;
    out.push_back({.task = task_between(features.phases[before], features.phases[after], features.shoulder_width),
                   .duration = one.span.duration(),
                   .recording = recording});
  }
}

}  // namespace

std::vector<TimedTransition> timed_transitions(const Database& database, const Contents& contents) {
  std::vector<std::uint32_t> recordings;
  for (std::uint32_t i = 0; i < contents.recordings.size(); ++i) {
    if (contents.recordings[i].motion && contents.recordings[i].document != 0) recordings.push_back(i);
  }
  const std::size_t looked_at = std::min(recordings.size(), kMostFittedRecordings);
  std::vector<TimedTransition> all;
  for (std::size_t i = 0; i < looked_at; ++i) {
    try {
      add_transitions(database, contents, recordings[i * recordings.size() / looked_at], all);
    } catch (const Error& error) {  // damaged, or gone by now
      if (error.code() != ErrorCode::corrupt && error.code() != ErrorCode::not_found) throw;
    }
  }
  if (all.size() <= kMostFittedTransitions) return all;
  std::vector<TimedTransition> some;
  for (std::size_t i = 0; i < kMostFittedTransitions; ++i) {
    some.push_back(all[i * all.size() / kMostFittedTransitions]);
  }
  return some;
}

DurationFit durations_of(const Database& database, const Contents& contents, const DurationModel& model) {
  if (model.fixed) return {.mean = *model.fixed};
  DurationFit fit;
  const TransitionStats& stats = contents.transitions;
  // Inferred transitions are gaps between signs whose own transitions lie inside them: no task is known of them.
  if (model.fitted && stats.count > 0 && !stats.inferred) fit = fit_durations(timed_transitions(database, contents));
  fit.count = stats.count;
  std::size_t unphased = 0;
  std::size_t phased = 0;
  for (const Segments::Member& member : contents.segments.members()) {
    for (RowId row = 0; row < member.table.size(); ++row) {
      if (member.table.kind(row) != RowKind::sign || member.numbers[member.table.recording(row)] == Segments::kNone)
        continue;
      ++(member.table.inferred(row) ? unphased : phased);
    }
  }
  if (model.fitted && stats.inferred && 2 * stats.count < unphased) {
    // Most of them touch: the few gaps are pauses, and tell nothing of transitions.
    fit.count = 0;
    fit.mean = kUnphasedTransition;
    return fit;
  }
  fit.median = model.fitted && stats.inferred;
  if (stats.count > 0) {
    fit.mean = model.fitted && stats.inferred ? stats.median : stats.mean;
  } else {
    fit.mean = phased > 0 ? kUnmeasuredTransition : kUnphasedTransition;
  }
  return fit;
}

}  // namespace signweave
