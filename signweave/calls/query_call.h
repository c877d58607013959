#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "signweave/calls/field.h"
#include "signweave/calls/search_limits.h"
#include "signweave/core/answer.h"
#include "signweave/database/database.h"
#include "signweave/query/bare_words.h"

namespace signweave {

template <class Visit>
void fields(Visit& visit, const SegmentPart& part) {
  visit.type("FoundPart");
  visit(AnswerField{.name = "name"}, part.name);
  span_fields(visit, part.span);
}

}  // namespace signweave

namespace signweave::calls {

/// Finds signs, phases and annotations.
struct QueryCall {
  std::string text;
  std::size_t limit = 0;        ///< 0: none
  std::int64_t timeout_ms = 0;  ///< 0: none
  bool explain = false;
};

template <class Visit>
void fields(Visit& visit, QueryCall& call) {
  visit(Field{.name = "text", .help = "words to find, or a query (docs/query.md)", .words = "TEXT", .required = true},
        call.text);
  limit_fields(visit, call);
  visit(Field{.name = "explain", .help = "show how the query is answered: the plan, and how many rows it was about"},
        call.explain);
}

struct QueryReport {
  std::vector<Segment> answers;
  std::vector<WordMatch> matches;   ///< [answer], if the text was words only
  std::vector<Notice> hints;        ///< for an empty answer: the names that the database does not have
  std::optional<std::string> plan;  ///< if requested; it is shown instead of the answers
};

/// An answer of a query.
struct FoundSegment {
  Segment segment;
  std::optional<std::string_view> match;  ///< if the text was words only
  std::optional<double> distance;         ///< if the query has `like`
};
template <class Visit>
void fields(Visit& visit, const FoundSegment& found) {
  const Segment& segment = found.segment;
  visit.type("FoundSegment");
  visit(AnswerField{.name = "recording"}, segment.recording);
  visit(AnswerField{.name = "tier"}, segment.tier);
  visit(AnswerField{.name = "name"}, segment.name);
  span_fields(visit, segment.span);
  visit(AnswerField{.name = "distance", .minimum = 0}, found.distance);
  visit(AnswerField{.name = "match",
                    .help = "how it fits, if the text was words only; the better first",
                    .one_of = {"exact", "folded", "sequence", "part", "label", "some"}},
        found.match);
  visit(AnswerField{.name = "bindings", .help = "the values of the query's variables"},
        given_if(!segment.bindings.empty(), segment.bindings));
  visit(AnswerField{.name = "parts"}, segment.parts);
}
/// How a query would be answered.
struct PlanAnswer {
  std::string plan;
};
template <class Visit>
void fields(Visit& visit, const PlanAnswer& answer) {
  visit.type("QueryPlan");
  visit(AnswerField{.name = "plan"}, answer.plan);
}
using QueryAnswer = std::variant<std::vector<FoundSegment>, PlanAnswer>;

/// A text that is not a query is taken as words to find, if it has no operators or is a gloss itself. Throws
/// SyntaxError, and Error{cancelled} when the time is up.
QueryReport run(const Database& database, const QueryCall& call);

QueryAnswer answer_of(const QueryReport& report);
/// As rows, the heading first.
std::vector<std::vector<std::string>> rows_of(const QueryReport& report);

}  // namespace signweave::calls
