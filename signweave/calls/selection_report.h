#pragma once

#include <string>
#include <utility>
#include <vector>

#include "signweave/choose/synthesizer.h"
#include "signweave/choose/target_cost.h"
#include "signweave/core/answer.h"

namespace signweave {

/// Pairs the values of an array with the names of their indices.
template <class Term, class Values>
std::vector<std::pair<std::string, double>> by_name(const Values& values) {
  std::vector<std::pair<std::string, double>> named;
  for (std::size_t i = 0; i < std::size(values); ++i) {
    named.emplace_back(name_of(static_cast<Term>(i)), static_cast<double>(values[i]));
  }
  return named;
}

/// The learned join weights, and how well they distinguish recorded neighbours from other pairs.
template <class Visit>
void fields(Visit& visit, const JoinWeights& weights) {
  visit.type("Weights");
  visit(AnswerField{.name = "join"}, by_name<JoinTerm>(weights.weights));
  visit(AnswerField{.name = "target"}, by_name<TargetTerm>(kTargetWeights));
  visit(AnswerField{.name = "speed_limit"}, weights.speed_limit);
  visit(AnswerField{.name = "pairs"}, weights.pairs);
  visit(AnswerField{.name = "comparisons"}, weights.comparisons);
  visit(AnswerField{.name = "folds"}, weights.folds);
  visit(AnswerField{.name = "wins"}, weights.wins);
  visit(AnswerField{.name = "default_wins"}, weights.default_wins);
}

/// What was learned about transitions from captured movements.
template <class Visit>
void fields(Visit& visit, const ResidualModel& residuals) {
  visit.type("TaughtTransitions", "what captured movements taught of transitions (docs/synthesis.md)");
  visit(AnswerField{.name = "learned"}, !residuals.centres.empty());
  visit(AnswerField{.name = "movements"}, residuals.movements);
  visit(AnswerField{.name = "recordings"}, residuals.recordings);
  visit(AnswerField{.name = "folds"}, residuals.folds);
  visit(AnswerField{.name = "left_out_by", .one_of = {"signer", "recording"}},
        std::string_view(residuals.by_signer ? "signer" : "recording"));
  visit(AnswerField{.name = "mean_ratio"}, residuals.mean_ratio);
  visit(AnswerField{.name = "median_ratio"}, residuals.median_ratio);
}

}  // namespace signweave

namespace signweave::calls {

/// The costs of joining a candidate to the best candidate before it.
struct JoinAnswer {
  CandidateCosts costs;
};
template <class Visit>
void fields(Visit& visit, const JoinAnswer& join) {
  visit.type("CandidateJoin");
  for (std::size_t i = 0; i < kJoinTerms; ++i) {
    visit(AnswerField{.name = name_of(static_cast<JoinTerm>(i))}, join.costs.join[i]);
  }
  visit(AnswerField{.name = "unknown"}, join.costs.join_unknown);
}

/// A candidate of a place, with its costs.
struct CandidateAnswer {
  std::string recording;
  std::size_t token = 0;
  FrameRange frames;  ///< of the recording
  CandidateCosts costs;
  bool joined = false;  ///< there is a place before it
};
template <class Visit>
void fields(Visit& visit, const CandidateAnswer& candidate) {
  const CandidateCosts& costs = candidate.costs;
  visit.type("Candidate");
  visit(AnswerField{.name = "recording"}, candidate.recording);
  visit(AnswerField{.name = "token"}, candidate.token);
  visit(AnswerField{.name = "frames"}, candidate.frames);
  visit(AnswerField{.name = "cost"}, costs.cost);
  visit(AnswerField{.name = "target_cost"}, costs.target_cost);
  visit(AnswerField{.name = "target"}, by_name<TargetTerm>(costs.target));
  visit(AnswerField{.name = "kept",
                    .help =
                        "whether it follows the previous choice in the recording, at no cost; not of the first place"},
        given_if(candidate.joined, costs.kept));
  visit(AnswerField{.name = "join_cost"}, given_if(candidate.joined, costs.join_cost));
  visit(AnswerField{.name = "join"}, given_if(candidate.joined, JoinAnswer{costs}));
}

/// A place of the utterance: what there was to choose from.
struct PlaceAnswer {
  std::vector<CandidateAnswer> candidates;
  std::size_t chosen = 0;  ///< index of a candidate
  double join_cost = 0;
};
template <class Visit>
void fields(Visit& visit, const PlaceAnswer& place) {
  visit.type("PlaceCandidates");
  visit(AnswerField{.name = "candidates"}, place.candidates);
  visit(AnswerField{.name = "chosen", .help = "the index of the chosen candidate"}, place.chosen);
  visit(AnswerField{.name = "join_cost"}, place.join_cost);
}

/// Every candidate of every place, with its costs and their terms. Requires a synthesis made with explanations.
std::vector<PlaceAnswer> places_of(const Synthesized& made);

/// As one line: "learned from 92 pairs of recorded neighbours, …".
std::string describe(const JoinWeights& weights);
/// As one line: "nothing learned from 12 movements of 2 recordings: too few to compare".
std::string describe(const ResidualModel& residuals);

}  // namespace signweave::calls
