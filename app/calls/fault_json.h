#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "signweave/core/error.h"

namespace signweave::calls {

/// What programs are told of a kind of fault, on the command line, over HTTP and on streams: "not_found".
std::string_view name_of(ErrorCode code) noexcept;

/// {"code", "message"}, "remedies" if there are any, and what the kind of error knows besides: of a query "line",
/// "column" and "caret", of an utterance "missing" glosses and a "suggestion".
nlohmann::json fault_json(const Error& error, std::string_view code, const std::string& message);

}  // namespace signweave::calls
