#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "signweave/notation/answer_json.h"

namespace signweave::wire {

/// A document as printed and sent: indented by two, invalid UTF-8 replaced, with a line feed at the end.
template <class Json>
std::string text_of(const Json& document) {
  return document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

}  // namespace signweave::wire
