#include "app/calls/fault_json.h"

#include <nlohmann/json.hpp>

#include "app/calls/json.h"
#include "signweave/choose/missing_glosses.h"
#include "signweave/query/parse.h"

namespace signweave::calls {

std::string_view name_of(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::bad_input:
      return "bad_input";
    case ErrorCode::not_found:
      return "not_found";
    case ErrorCode::already_exists:
      return "already_exists";
    case ErrorCode::conflict:
      return "conflict";
    case ErrorCode::corrupt:
      return "corrupt";
    case ErrorCode::unsupported:
      return "unsupported";
    case ErrorCode::io:
      return "io";
    case ErrorCode::cancelled:
      return "cancelled";
  }
  return "io";
}

nlohmann::json fault_json(const Error& error, std::string_view code, const std::string& message) {
  nlohmann::json fault = {{"code", code}, {"message", message}};
  if (!error.remedies().empty()) fault["remedies"] = json_of(error.remedies());
  if (const auto* query = dynamic_cast<const QueryError*>(&error)) {
    fault["line"] = query->line;
    fault["column"] = query->column;
    fault["caret"] = query->caret;
  }
  if (const auto* glosses = dynamic_cast<const MissingGlosses*>(&error)) {
    nlohmann::json& list = fault["missing"] = nlohmann::json::array();
    for (const MissingGloss& missing : glosses->missing) {
      list.push_back({{"gloss", missing.gloss}, {"matches", missing.matches}, {"folds", missing.folds}});
    }
    if (!glosses->suggestion.empty()) fault["suggestion"] = glosses->suggestion;
  }
  return fault;
}

}  // namespace signweave::calls
