#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/choose/missing_glosses.h"
#include "signweave/core/answer.h"

namespace signweave {

template <class Visit>
void fields(Visit& visit, const MissingGloss& missing) {
  visit.type("MissingGloss");
  visit(AnswerField{.name = "gloss"}, missing.gloss);
  visit(AnswerField{.name = "matches"}, missing.matches);
  visit(AnswerField{.name = "folds", .help = "whether the matches differ in case, accents or width only"},
        missing.folds);
}

}  // namespace signweave

namespace signweave::wire {

/// An error as reported to programs.
struct FaultAnswer {
  std::string code;
  std::string message;
  Remedies remedies;
  std::optional<std::size_t> line;  ///< this and the next two: of an error in a query or an expression
  std::optional<std::size_t> column;
  std::optional<std::string> caret;
  std::optional<std::vector<MissingGloss>> missing;  ///< this and the next: of an utterance with unknown glosses
  std::optional<std::string> suggestion;
};
template <class Visit>
void fields(Visit& visit, const FaultAnswer& fault) {
  visit.type("FaultText");
  visit(AnswerField{.name = "code"}, fault.code);
  visit(AnswerField{.name = "message", .help = "one line: what is wrong"}, fault.message);
  visit(AnswerField{.name = "remedies", .help = "those with a value set together, or one of the others"},
        given_if(!fault.remedies.empty(), fault.remedies));
  visit(AnswerField{.name = "line"}, fault.line);
  visit(AnswerField{.name = "column"}, fault.column);
  visit(AnswerField{.name = "caret", .help = "of a query: its line, and a caret under the place"}, fault.caret);
  visit(AnswerField{.name = "missing", .help = "glosses of an utterance that no sign has"}, fault.missing);
  visit(AnswerField{.name = "suggestion", .help = "the utterance with the first match of each"}, fault.suggestion);
}

/// The answer of a call that failed.
struct FailedAnswer {
  FaultAnswer error;
};
template <class Visit>
void fields(Visit& visit, const FailedAnswer& answer) {
  visit.type("Fault");
  visit(AnswerField{.name = "error"}, answer.error);
}

/// Each includes what the kind of error adds: the position in a query, the missing glosses of an utterance.
FaultAnswer fault_of(const Error& error, std::string_view code, const std::string& message);
nlohmann::json fault_json(const Error& error, std::string_view code, const std::string& message);

}  // namespace signweave::wire
