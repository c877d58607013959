#include "app/wire/fault.h"

#include <nlohmann/json.hpp>

#include "signweave/core/syntax_error.h"
#include "signweave/notation/answer_json.h"

namespace signweave::wire {

FaultAnswer fault_of(const Error& error, std::string_view code, const std::string& message) {
  FaultAnswer fault{.code = std::string(code), .message = message, .remedies = error.remedies()};
  if (const auto* syntax = dynamic_cast<const SyntaxError*>(&error)) {
    fault.line = syntax->line;
    fault.column = syntax->column;
    fault.caret = syntax->caret;
  }
  if (const auto* glosses = dynamic_cast<const MissingGlosses*>(&error)) {
    fault.missing = glosses->missing;
    if (!glosses->suggestion.empty()) fault.suggestion = glosses->suggestion;
  }
  return fault;
}

nlohmann::json fault_json(const Error& error, std::string_view code, const std::string& message) {
  return answer_json<nlohmann::json>(fault_of(error, code, message));
}

}  // namespace signweave::wire
