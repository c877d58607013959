#pragma once

#include <nlohmann/json.hpp>

namespace signweave::server {

/// The schemas of all answers, by the names that the table of routes uses.
nlohmann::ordered_json answer_schemas();

/// The OpenAPI 3.1 document, generated from the table of routes.
nlohmann::ordered_json openapi_document();

}  // namespace signweave::server
