#pragma once

#include <string>

#include "app/calls/field.h"
#include "app/calls/json.h"
#include "signweave/database/database.h"

namespace signweave::calls {

/// What can be asked for in a database, and the words of the language that asks: for completion.
nlohmann::ordered_json vocabulary_json(const Database& database);

/// What the annotations of a tier say.
struct LabelsCall {
  std::string tier;
  std::size_t limit = 5000;
};

template <class Visit>
void fields(Visit& visit, LabelsCall& call) {
  visit(Field{.name = "tier", .help = "id of the tier", .required = true}, call.tier);
  visit(Field{.name = "limit",
              .help = "of more labels those that most annotations have",
              .shows_default = true,
              .range = Range{std::size_t{1}, std::size_t{1'000'000}}},
        call.limit);
}

/// Throws Error{not_found} for a tier that there is not, with near matches.
nlohmann::ordered_json labels_json(const Database& database, const LabelsCall& call);

}  // namespace signweave::calls
