#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "signweave/calls/field.h"
#include "signweave/calls/search_limits.h"
#include "signweave/core/answer.h"
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
              .words = "recording"},
        call.recordings);
  limit_fields(visit, call);
}

/// Throws SyntaxError for a wrong expression, Error{not_found} for an unknown recording or one without annotation,
/// Error{cancelled} when the time is up.
std::vector<XPathAnswer> run(const Database& database, const XPathCall& call);

/// A node, or the value of an expression that is not a set of nodes.
struct NodeAnswer {
  std::string recording;
  std::string_view kind;
  std::optional<std::string> name;                        ///< of an element or attribute
  std::variant<std::string, bool, OrNull<double>> value;  ///< of a node its text; null: not a finite number
  std::optional<std::string> xml;                         ///< of a node
};
template <class Visit>
void fields(Visit& visit, const NodeAnswer& node) {
  visit.type("Node");
  visit(AnswerField{.name = "recording"}, node.recording);
  visit(AnswerField{.name = "kind",
                    .one_of = {"document", "element", "attribute", "text", "comment", "instruction", "namespace",
                               "string", "number", "boolean"}},
        node.kind);
  visit(AnswerField{.name = "name", .help = "of an element or attribute"}, node.name);
  visit(AnswerField{.name = "value", .help = "of a node its text; null: not a finite number"}, node.value);
  visit(AnswerField{.name = "xml", .help = "of a node"}, node.xml);
}

std::vector<NodeAnswer> node_answers(const std::vector<XPathAnswer>& answers);
/// As rows, the heading first.
std::vector<std::vector<std::string>> rows_of(const std::vector<XPathAnswer>& answers);

}  // namespace signweave::calls
