#pragma once

#include <string>
#include <vector>

#include "app/calls/field.h"
#include "app/calls/json.h"
#include "signweave/database/database.h"

namespace signweave::calls {

/// Evaluates an XPath 1.0 expression over the stored annotation documents.
struct XPathCall {
  std::string expression;
  std::vector<std::string> recordings;
  std::size_t limit = 0;        ///< 0: none
  std::int64_t timeout_ms = 0;  ///< 0: none
};

template <class Visit>
void fields(Visit& visit, XPathCall& call) {
  visit(Field{.name = "expression",
              .help = "XPath 1.0, such as //ANNOTATION_VALUE; docs/xpath.md has examples",
              .words = "EXPRESSION",
              .required = true},
        call.expression);
  visit(Field{.name = "recordings",
              .help = "look at this recording only; may be given several times",
              .words = "--recording"},
        call.recordings);
  visit(Field{.name = "limit",
              .help = "at most so many answers",
              .range = Range{std::int64_t{1}, std::int64_t{1'000'000'000}}},
        call.limit);
  visit(Field{.name = "timeout_ms",
              .help = "give up after so many ms",
              .words = "--timeout",
              .range = Range{std::int64_t{1}, std::int64_t{1'000'000'000}}},
        call.timeout_ms);
}

/// Throws QueryError for a wrong expression, Error{not_found} for an unknown recording or one without annotation,
/// Error{cancelled} when the time is over.
std::vector<XPathAnswer> run(const Database& database, const XPathCall& call);

/// [{"recording", "kind", "value"}], of nodes also "xml", of elements and attributes "name"; numbers and booleans are
/// JSON's, with null for what is no number.
nlohmann::json json_of(const std::vector<XPathAnswer>& answers);
/// As rows, the heading first.
std::vector<std::vector<std::string>> rows_of(const std::vector<XPathAnswer>& answers);

}  // namespace signweave::calls
