#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/calls/field.h"
#include "app/calls/json.h"
#include "signweave/database/database.h"
#include "signweave/query/bare_words.h"

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
  visit(Field{.name = "limit",
              .help = "at most so many answers",
              .range = Range{std::int64_t{1}, std::int64_t{1'000'000'000}}},
        call.limit);
  visit(Field{.name = "timeout_ms",
              .help = "give up after so many ms",
              .words = "--timeout",
              .range = Range{std::int64_t{1}, std::int64_t{1'000'000'000}}},
        call.timeout_ms);
  visit(Field{.name = "explain", .help = "show how the query is answered: the plan, and how many rows it was about"},
        call.explain);
}

struct QueryReport {
  std::vector<Segment> answers;
  std::vector<WordMatch> matches;   ///< [answer], where the text was words only
  std::vector<Notice> hints;        ///< of an empty answer: what the database does not know
  std::optional<std::string> plan;  ///< where it was asked for: it is shown instead of the answers
};

/// A text that no query is made of is taken for words to find, where it has no operators or is a gloss itself.
/// Throws QueryError, Error{cancelled} when the time is over.
QueryReport run(const Database& database, const QueryCall& call);

nlohmann::json json_of(const QueryReport& report);
/// As rows, the heading first.
std::vector<std::vector<std::string>> rows_of(const QueryReport& report);

}  // namespace signweave::calls
