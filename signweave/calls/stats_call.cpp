#include "signweave/calls/stats_call.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "signweave/drawing/transition_plot.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave::calls {

namespace {

/// A function that returns how the hands move in a transition of the recording; empty if nothing was measured.
MotionOf motion_of(const Database& database, const Contents& contents, std::uint32_t recording,
                   const std::vector<Sign>& signs) {
  auto features = std::make_shared<const RecordingFeatures>(database.features(contents.recordings[recording].name));
  auto places =
      std::make_shared<const std::vector<std::vector<std::size_t>>>(phase_places_of(contents.segments, recording));
  if (!features->why_not.empty() || places->size() != signs.size()) return {};
  const auto phases_of = [features, places](std::size_t sign) {
    std::vector<PhaseFeatures> phases;
    for (const std::size_t place : (*places)[sign]) {
      if (place < features->phases.size()) phases.push_back(features->phases[place]);
    }
    return phases;
  };
  return [=](const Sign& from, const Sign& to, const AnnotatedTransition& transition) {
    return motion_between(from, phases_of(transition.from), to, phases_of(transition.to), features->shoulder_width);
  };
}

}  // namespace

Counted run(const Database& database, const StatsCall& call, const Listener& listener) {
  const std::shared_ptr<const Contents> held = database.contents();
  const Contents& contents = *held;
  const std::string& recording = call.recording;
  if (!recording.empty()) contents.at(recording);  // throws if there is none
  Counted counted;
  for (std::size_t i = 0; i < contents.recordings.size(); ++i) {
    const std::string& name = contents.recordings[i].name;
    if (!recording.empty() && name != recording) continue;
    counted.names.push_back(name);
    counted.signs.push_back(signs_of(contents.segments, static_cast<std::uint32_t>(i)));
    MotionOf hands;
    try {
      hands = motion_of(database, contents, static_cast<std::uint32_t>(i), counted.signs.back());
    } catch (const Error& error) {  // durations can still be reported
      listener.report_fault(error.what());
    }
    counted.transitions.push_back(recorded_transitions(name, counted.signs.back(), hands));
    counted.all.insert(counted.all.end(), counted.transitions.back().begin(), counted.transitions.back().end());
  }
  const bool none = std::all_of(counted.signs.begin(), counted.signs.end(), [](const auto& of) { return of.empty(); });
  if (!recording.empty() && none) {
    throw Error(ErrorCode::not_found,
                fmt::format("{}: no sign is annotated, so there is nothing to count; import its annotation with signs "
                            "on a sign tier",
                            recording));
  }
  return counted;
}

std::vector<NamedSummary> summaries_of(const Counted& counted) {
  std::vector<NamedSummary> summaries;
  for (std::size_t i = 0; i < counted.names.size(); ++i) {
    if (!counted.transitions[i].empty()) summaries.push_back({counted.names[i], describe(counted.transitions[i])});
  }
  if (summaries.size() != 1) summaries.push_back({"", describe(counted.all)});
  return summaries;
}

std::vector<Sign> all_signs(const Counted& counted) {
  std::vector<Sign> signs;
  for (const std::vector<Sign>& of : counted.signs) signs.insert(signs.end(), of.begin(), of.end());
  return signs;
}

std::vector<NgramStats> all_ngrams(const Counted& counted, std::size_t longest) {
  std::vector<NgramStats> ngrams;
  for (std::size_t length = 2; length <= longest; ++length) {
    std::vector<NgramStats> of = ngrams_of(counted.signs, length);
    std::move(of.begin(), of.end(), std::back_inserter(ngrams));
  }
  return ngrams;
}

std::string plot_of(const Counted& counted, const std::string& where) {
  std::vector<TransitionPanel> panels;
  for (std::size_t i = 0; i < counted.names.size(); ++i) {
    const std::vector<RecordedTransition> of = counted_transitions(counted.transitions[i]);
    if (of.empty()) continue;
    const TransitionSummary summary = describe(of);
    TransitionPanel panel{.title = counted.names[i],
                          .mean = summary.whole.duration.mean,
                          .deviation = summary.whole.duration.deviation,
                          .inferred = summary.inferred};
    for (const RecordedTransition& one : of) {
      const auto ms = [](Milliseconds time) { return static_cast<double>(time.count()); };
      const AnnotatedTransition& transition = one.transition;
      panel.bars.push_back({.from = one.from,
                            .to = one.to,
                            .begin = ms(transition.span.begin),
                            .retraction = summary.inferred ? 0 : ms(transition.retraction),
                            .preparation = summary.inferred ? 0 : ms(transition.preparation),
                            .whole = ms(transition.span.duration())});
    }
    panels.push_back(std::move(panel));
  }
  if (panels.empty()) {
    throw Error(ErrorCode::not_found, where +
                                          ": not written, because no transition is recorded: signs must follow each "
                                          "other, with phases or with gaps between them");
  }
  return transition_plot(panels);
}

std::string csv_fault(const StatsCall& call) {
  return (call.pairs ? 1 : 0) + (call.glosses ? 1 : 0) + (call.ngrams > 0 ? 1 : 0) > 1
             ? "csv holds one table: give one of pairs, glosses and ngrams"
             : "";
}

StatisticsAnswer answer_of(const StatsCall& call, const Counted& counted) {
  StatisticsAnswer answer{.all = describe(counted.all), .recordings = {}, .pairs = {}, .glosses = {}, .ngrams = {}};
  for (std::size_t i = 0; i < counted.names.size(); ++i) {
    answer.recordings.push_back({.summary = describe(counted.transitions[i]),
                                 .recording = counted.names[i],
                                 .signs = counted.signs[i].size(),
                                 .transitions = counted.transitions[i]});
  }
  if (call.pairs) answer.pairs = by_pair(counted.all);
  if (call.glosses) answer.glosses = glosses_of(all_signs(counted));
  if (call.ngrams > 0) answer.ngrams = all_ngrams(counted, call.ngrams);
  return answer;
}

Rows csv_of(const StatsCall& call, const Counted& counted) {
  if (call.pairs) return pair_csv(by_pair(counted.all));
  if (call.glosses) return gloss_csv(glosses_of(all_signs(counted)));
  if (call.ngrams > 0) return ngram_csv(all_ngrams(counted, call.ngrams));
  return transition_csv(summaries_of(counted));
}

}  // namespace signweave::calls

namespace signweave {

std::vector<std::pair<std::string, double>> named_quantiles(const Distribution& of) {
  std::vector<std::pair<std::string, double>> named;
  for (std::size_t i = 0; i < of.quantiles.size(); ++i) {
    named.emplace_back(fmt::format("{:g}", Distribution::kQuantiles[i]), of.quantiles[i]);
  }
  return named;
}

}  // namespace signweave
