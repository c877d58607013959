#include "signweave/calls/stats_call.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "signweave/calls/table.h"
#include "signweave/core/text.h"
#include "signweave/drawing/locus_plot.h"
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

/// One palm over the strokes of a sign, from the measures of its phases; none if one of them is not measured.
std::optional<PalmStroke> palm_of(const Sign& sign, std::span<const std::size_t> places,
                                  const RecordingFeatures& features, Side side) {
  std::optional<PalmStroke> palm;
  for (std::size_t i = 0; i < sign.phases.size(); ++i) {
    if (sign.phases[i].kind != PhaseKind::stroke) continue;
    if (i >= places.size() || places[i] >= features.phases.size()) return std::nullopt;
    const PhaseFeatures& phase = features.phases[places[i]];
    const HandOver& hand = phase.hands[static_cast<std::size_t>(side)];
    if (!phase.known || !hand.known) return std::nullopt;
    if (!palm) palm = PalmStroke{.begin = hand.begin.position};
    palm->end = hand.end.position;
    palm->path += hand.path_length;
  }
  return palm;
}

/// Adds the measured tokens of a recording that has features.
void add_placed(const RecordingFeatures& features, const std::vector<std::vector<std::size_t>>& places,
                const std::string& recording, const std::vector<Sign>& signs, std::vector<PlacedToken>& out) {
  if (!features.why_not.empty() || places.size() != signs.size()) return;
  for (std::size_t i = 0; i < signs.size(); ++i) {
    const Sign& sign = signs[i];
    PlacedToken token{
        .gloss = sign.gloss,
        .recording = recording,
        .span = sign.stroke_span().value_or(sign.span),
        .hand = sign.hand,
        .inferred = sign.inferred,
        .palms = {palm_of(sign, places[i], features, Side::left), palm_of(sign, places[i], features, Side::right)},
        .shoulder_width = features.shoulder_width};
    if (token.palms[0] || token.palms[1]) out.push_back(std::move(token));
  }
}

/// Fills in the loci. A recording whose features are damaged was already reported.
void add_loci(const Database& database, const Contents& contents, const StatsCall& call, Counted& counted) {
  std::vector<PlacedToken> tokens;
  for (std::size_t i = 0; i < counted.names.size(); ++i) {
    const auto recording = static_cast<std::uint32_t>(
        std::ranges::find(contents.recordings, counted.names[i], &RecordingInfo::name) - contents.recordings.begin());
    const std::size_t before = tokens.size();
    try {
      add_placed(database.features(counted.names[i]), phase_places_of(contents.segments, recording), counted.names[i],
                 counted.signs[i], tokens);
    } catch (const Error&) {
      continue;
    }
    if (before == 0 && !tokens.empty()) counted.body = database.snapshot().hand_trace(recording).body;
  }
  if (!call.gloss.empty()) {
    const std::string form = match_form(call.gloss);
    std::vector<std::string> known;
    for (const PlacedToken& token : tokens) known.push_back(token.gloss);
    std::erase_if(tokens, [&](const PlacedToken& token) { return match_form(token.gloss) != form; });
    if (tokens.empty()) {
      throw Error(ErrorCode::not_found, fmt::format("no measured sign has the gloss \"{}\"{}", printable(call.gloss),
                                                    did_you_mean(call.gloss, known)));
    }
  }
  counted.loci = gloss_loci(tokens, counted.body);
}

std::string plot_of_loci(const Counted& counted, const std::string& where) {
  if (counted.loci.empty()) {
    throw Error(ErrorCode::not_found, where + ": not written, because no stroke is measured: import signs with motion");
  }
  std::vector<LocusPanel> panels;
  for (const GlossLoci& gloss : counted.loci) {
    if (panels.size() == kMostPlottedGlosses) break;
    LocusPanel panel{.title = fmt::format("{}: {}, spread {:.0f} cm", gloss.gloss,
                                          calls::counted(gloss.tokens.size(), "token"), 100 * gloss.spread()),
                     .tokens = {}};
    for (const GlossLoci::Token& token : gloss.tokens) {
      panel.tokens.push_back(
          {token.palm.begin, token.palm.end,
           fmt::format("{} {} in {} at {} ms", token.hand == Side::left ? "left hand of" : "right hand of", gloss.gloss,
                       token.recording, token.span.begin.count())});
    }
    panels.push_back(std::move(panel));
  }
  std::vector<MarkedLocus> marks;
  for (const std::string_view name : built_in_loci()) {
    const LocusRef locus{.kind = LocusRef::Kind::name, .name = std::string(name), .numbers = {}};
    marks.push_back({locus.name, resolve(locus, {}, 0, counted.body).at});
  }
  return locus_plot(panels, counted.body, marks);
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
  if (!call.gloss.empty() && !call.loci) {
    throw Error(ErrorCode::bad_input, "'gloss' applies only to 'loci': give both");
  }
  if (call.loci) add_loci(database, contents, call, counted);
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

std::string plot_of(const StatsCall& call, const Counted& counted, const std::string& where) {
  if (call.loci) return plot_of_loci(counted, where);
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
  return (call.pairs ? 1 : 0) + (call.glosses ? 1 : 0) + (call.ngrams > 0 ? 1 : 0) + (call.loci ? 1 : 0) > 1
             ? "csv holds one table: give one of pairs, glosses, ngrams and loci"
             : "";
}

StatisticsAnswer answer_of(const StatsCall& call, const Counted& counted) {
  StatisticsAnswer answer{
      .all = describe(counted.all), .recordings = {}, .pairs = {}, .glosses = {}, .ngrams = {}, .loci = {}};
  for (std::size_t i = 0; i < counted.names.size(); ++i) {
    answer.recordings.push_back({.summary = describe(counted.transitions[i]),
                                 .recording = counted.names[i],
                                 .signs = counted.signs[i].size(),
                                 .transitions = counted.transitions[i]});
  }
  if (call.pairs) answer.pairs = by_pair(counted.all);
  if (call.glosses) answer.glosses = glosses_of(all_signs(counted));
  if (call.ngrams > 0) answer.ngrams = all_ngrams(counted, call.ngrams);
  if (call.loci) answer.loci = counted.loci;
  return answer;
}

Rows csv_of(const StatsCall& call, const Counted& counted) {
  if (call.pairs) return pair_csv(by_pair(counted.all));
  if (call.glosses) return gloss_csv(glosses_of(all_signs(counted)));
  if (call.ngrams > 0) return ngram_csv(all_ngrams(counted, call.ngrams));
  if (call.loci) return loci_csv(counted.loci);
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
