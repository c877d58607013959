#pragma once

#include <string>
#include <vector>

#include "signweave/calls/field.h"
#include "signweave/core/answer.h"
#include "signweave/database/database.h"
#include "signweave/query/vocabulary.h"

namespace signweave {

template <class Visit>
void fields(Visit& visit, const Vocabulary::Gloss& gloss) {
  visit.type("GlossTokens");
  visit(AnswerField{.name = "gloss"}, gloss.gloss);
  visit(AnswerField{.name = "tokens"}, gloss.tokens);
}
template <class Visit>
void fields(Visit& visit, const LanguageWords& words) {
  visit.type("LanguageWords");
  visit(AnswerField{.name = "fields"}, words.fields);
  visit(AnswerField{.name = "links"}, words.links);
  visit(AnswerField{.name = "phases"}, words.phases);
  visit(AnswerField{.name = "hands", .help = "values of hand"}, words.hands);
  visit(AnswerField{.name = "two_handed", .help = "values of hands"}, words.two_handed);
  visit(AnswerField{.name = "functions"}, words.functions);
  visit(AnswerField{.name = "points"}, words.points);
}
template <class Visit>
void fields(Visit& visit, const LabelCount& label) {
  visit.type("LabelCount");
  visit(AnswerField{.name = "label"}, label.label);
  visit(AnswerField{.name = "annotations"}, label.annotations);
}

}  // namespace signweave

namespace signweave::calls {

/// The names that queries of a database can use, and the words of the query language: for completion.
struct VocabularyAnswer {
  Vocabulary names;
  LanguageWords language;
};
template <class Visit>
void fields(Visit& visit, const VocabularyAnswer& answer) {
  visit.type("Vocabulary");
  visit(AnswerField{.name = "glosses"}, answer.names.glosses);
  visit(AnswerField{.name = "tiers"}, answer.names.tiers);
  visit(AnswerField{.name = "recordings"}, answer.names.recordings);
  visit(AnswerField{.name = "signers"}, answer.names.signers);
  visit(AnswerField{.name = "language", .help = "the words of the query language by role"}, answer.language);
}

VocabularyAnswer vocabulary_of(const Database& database);

/// Lists the labels of a tier's annotations.
struct LabelsCall {
  std::string tier;
  std::size_t limit = 5000;
};

template <class Visit>
void fields(Visit& visit, LabelsCall& call) {
  visit(Field{.name = "tier", .help = "id of the tier", .required = true}, call.tier);
  visit(Field{.name = "limit",
              .help = "at most so many labels: those that most annotations have",
              .shows_default = true,
              .range = Range{std::size_t{1}, std::size_t{1'000'000}}},
        call.limit);
}

struct LabelsAnswer {
  std::string tier;
  std::vector<LabelCount> labels;  ///< sorted by label
  std::size_t left_out = 0;        ///< labels of fewer annotations that the limit left out
};
template <class Visit>
void fields(Visit& visit, const LabelsAnswer& answer) {
  visit.type("Labels");
  visit(AnswerField{.name = "tier"}, answer.tier);
  visit(AnswerField{.name = "labels"}, answer.labels);
  visit(AnswerField{.name = "left_out", .help = "labels of fewer annotations that the limit left out"},
        answer.left_out);
}

/// Throws Error{not_found} for a tier that does not exist, with near matches.
LabelsAnswer run(const Database& database, const LabelsCall& call);

}  // namespace signweave::calls
