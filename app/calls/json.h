#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/time.h"

/// What the JSON of several calls shares.
namespace signweave::calls {

/// A document as it is printed and sent: indented by two, bytes that are no UTF-8 replaced, a line feed at the end.
template <class Json>
std::string text_of(const Json& document) {
  return document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

/// {"parameter", "value"} each, without a value if the user has to choose it.
nlohmann::json json_of(const Remedies& remedies);

/// {"where", "text"} each, and "remedies" if there are any.
nlohmann::json json_of(const std::vector<Notice>& notices);

/// What sources say of themselves, such as that a demo's shapes are placeholders: an object of names and values.
nlohmann::json declarations_json(const std::vector<std::pair<std::string, std::string>>& declarations);

nlohmann::json span_json(TimeSpan span);
nlohmann::json frames_json(FrameRange frames);

}  // namespace signweave::calls
