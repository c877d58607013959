#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "signweave/calls/gloss_loci.h"
#include "signweave/core/answer.h"
#include "signweave/features/gloss_stats.h"
#include "signweave/features/transition_stats.h"

/// Statistics as answers (core/answer.h). Durations are milliseconds.
namespace signweave {

template <class Visit>
void fields(Visit& visit, const Histogram& histogram) {
  visit.type("Histogram");
  visit(AnswerField{.name = "begin"}, histogram.begin);
  visit(AnswerField{.name = "width"}, histogram.width);
  visit(AnswerField{.name = "counts"}, histogram.counts);
}

std::vector<std::pair<std::string, double>> named_quantiles(const Distribution& of);

template <class Visit>
void fields(Visit& visit, const Distribution& of) {
  const bool any = of.count > 0;
  visit.type("Distribution");
  visit(AnswerField{.name = "count", .help = "of 0 there is nothing else"}, of.count);
  visit(AnswerField{.name = "mean"}, given_if(any, of.mean));
  visit(AnswerField{.name = "sd"}, given_if(any, of.deviation));
  visit(AnswerField{.name = "mean_95", .help = "the 95 % interval of the mean; null: one value has none"},
        given_if(any, null_unless(of.count > 1, std::vector{of.mean_low, of.mean_high})));
  visit(AnswerField{.name = "least"}, given_if(any, of.least));
  visit(AnswerField{.name = "most"}, given_if(any, of.most));
  visit(AnswerField{.name = "quantiles"}, given_if(any, named_quantiles(of)));
  visit(AnswerField{.name = "histogram"}, given_if(any, of.histogram));
}

template <class Visit>
void fields(Visit& visit, const TravelStats& hand) {
  visit.type("HandTravelStats");
  visit(AnswerField{.name = "displacement_m"}, hand.displacement);
  visit(AnswerField{.name = "path_m"}, hand.path);
  visit(AnswerField{.name = "speed_m_per_s"}, hand.speed);
}

template <class Visit>
void fields(Visit& visit, const PartStats& part) {
  visit.type("TransitionPart");
  visit(AnswerField{.name = "duration_ms"}, part.duration);
  visit(AnswerField{.name = "left_hand"}, given_if(part.hands[0].path.count > 0, part.hands[0]));
  visit(AnswerField{.name = "right_hand"}, given_if(part.hands[1].path.count > 0, part.hands[1]));
}

template <class Visit>
void summary_fields(Visit& visit, const TransitionSummary& summary) {
  visit(AnswerField{.name = "inferred", .help = "gaps between signs, because no phases are annotated"},
        summary.inferred);
  visit(AnswerField{.name = "whole"}, summary.whole);
  visit(AnswerField{.name = "retraction", .help = "missing if inferred"},
        given_if(!summary.inferred, summary.retraction));
  visit(AnswerField{.name = "preparation", .help = "missing if inferred"},
        given_if(!summary.inferred, summary.preparation));
}
template <class Visit>
void fields(Visit& visit, const TransitionSummary& summary) {
  visit.type("TransitionSummary");
  summary_fields(visit, summary);
}

template <class Visit>
void fields(Visit& visit, const HandTravel& travel) {
  visit.type("HandTravel");
  visit(AnswerField{.name = "displacement_m"}, travel.displacement);
  visit(AnswerField{.name = "path_m"}, travel.path);
}

template <class Visit>
void fields(Visit& visit, const RecordedTransition& transition) {
  const AnnotatedTransition& of = transition.transition;
  const auto travel = [&](std::size_t side) {
    const HandTravel hand = transition.motion ? transition.motion->whole[side] : HandTravel();
    return given_if(hand.known, hand);
  };
  visit.type("RecordedTransition");
  visit(AnswerField{.name = "from"}, transition.from);
  visit(AnswerField{.name = "to"}, transition.to);
  span_fields(visit, of.span);
  visit(AnswerField{.name = "inferred"}, of.inferred);
  visit(AnswerField{.name = "retraction_ms"}, given_if(!of.inferred, of.retraction.count()));
  visit(AnswerField{.name = "preparation_ms"}, given_if(!of.inferred, of.preparation.count()));
  visit(AnswerField{.name = "left_hand"}, travel(0));
  visit(AnswerField{.name = "right_hand"}, travel(1));
}

template <class Visit>
void fields(Visit& visit, const PairStats& pair) {
  visit.type("PairStatistics");
  visit(AnswerField{.name = "from"}, pair.from);
  visit(AnswerField{.name = "to"}, pair.to);
  summary_fields(visit, pair.summary);
}
template <class Visit>
void fields(Visit& visit, const GlossStats& gloss) {
  visit.type("GlossStatistics");
  visit(AnswerField{.name = "gloss"}, gloss.gloss);
  visit(AnswerField{.name = "sign_ms"}, gloss.sign);
  visit(AnswerField{.name = "stroke_ms"}, gloss.stroke);
}
template <class Visit>
void fields(Visit& visit, const NgramStats& ngram) {
  visit.type("NgramStatistics");
  visit(AnswerField{.name = "glosses"}, ngram.glosses);
  visit(AnswerField{.name = "count"}, ngram.count);
  visit(AnswerField{.name = "interval_ms"}, ngram.interval);
}

namespace calls {

struct RecordingStatistics {
  TransitionSummary summary;
  std::string recording;
  std::size_t signs = 0;
  std::vector<RecordedTransition> transitions;
};
template <class Visit>
void fields(Visit& visit, const RecordingStatistics& one) {
  visit.type("RecordingStatistics");
  visit(AnswerField{.name = "recording"}, one.recording);
  visit(AnswerField{.name = "signs"}, one.signs);
  summary_fields(visit, one.summary);
  visit(AnswerField{.name = "transitions"}, one.transitions);
}

template <class Visit>
void fields(Visit& visit, const PlaceStats& place) {
  visit.type("PlaceStatistics");
  visit(AnswerField{.name = "azimuth_deg", .help = "0 is straight ahead, positive to the signer's left"},
        place.azimuth);
  visit(AnswerField{.name = "elevation_deg"}, place.elevation);
  visit(AnswerField{.name = "distance_sw", .help = "shoulder widths"}, place.distance);
  visit(AnswerField{.name = "nearest", .help = "the built-in locus nearest to the medians"}, place.nearest);
  visit(AnswerField{.name = "places", .help = "number of places more than 15 cm apart"}, place.places);
  visit(AnswerField{.name = "spread_m", .help = "root mean square distance from the mean"}, place.spread);
}
template <class Visit>
void fields(Visit& visit, const GlossLoci::Token& token) {
  const auto numbers = [](const Eigen::Vector3f& at) { return std::vector<float>{at.x(), at.y(), at.z()}; };
  visit.type("PlacedToken");
  visit(AnswerField{.name = "recording"}, token.recording);
  span_fields(visit, token.span);
  visit(AnswerField{.name = "hand"}, std::string_view(token.hand == Side::left ? "left" : "right"));
  visit(AnswerField{.name = "begin", .help = "to the signer's left, up, forward; shoulder widths"},
        numbers(token.palm.begin));
  visit(AnswerField{.name = "end"}, numbers(token.palm.end));
}
template <class Visit>
void fields(Visit& visit, const GlossLoci& gloss) {
  visit.type("GlossLoci");
  visit(AnswerField{.name = "gloss"}, gloss.gloss);
  visit(AnswerField{.name = "hand"}, std::string_view(gloss.hand == Side::left ? "left" : "right"));
  visit(AnswerField{.name = "heading", .help = "away from the signer, toward it, or neither"}, name_of(gloss.heading));
  visit(AnswerField{.name = "spread_m", .help = "the greater one of begin and end"}, gloss.spread());
  visit(AnswerField{.name = "begin", .help = "of the strokes"}, gloss.begin);
  visit(AnswerField{.name = "end", .help = "of the strokes"}, gloss.end);
  visit(AnswerField{.name = "tokens"}, gloss.tokens);
}

struct StatisticsAnswer {
  TransitionSummary all;
  std::vector<RecordingStatistics> recordings;
  std::optional<std::vector<PairStats>> pairs;  ///< this and those below: if requested
  std::optional<std::vector<GlossStats>> glosses;
  std::optional<std::vector<NgramStats>> ngrams;
  std::optional<std::vector<GlossLoci>> loci;
};
template <class Visit>
void fields(Visit& visit, const StatisticsAnswer& answer) {
  visit.type("Statistics");
  visit(AnswerField{.name = "all"}, answer.all);
  visit(AnswerField{.name = "recordings"}, answer.recordings);
  visit(AnswerField{.name = "pairs"}, answer.pairs);
  visit(AnswerField{.name = "glosses"}, answer.glosses);
  visit(AnswerField{.name = "ngrams"}, answer.ngrams);
  visit(AnswerField{.name = "loci", .help = "by descending spread"}, answer.loci);
}

}  // namespace calls
}  // namespace signweave
