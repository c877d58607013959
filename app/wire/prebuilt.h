#pragma once

#include <nlohmann/json.hpp>

#include "app/wire/answer_schema.h"
#include "signweave/notation/answer_json.h"

namespace signweave::wire {

/// JSON that was built earlier, from an answer of one of these types.
template <class... Answers>
struct Prebuilt {
  nlohmann::json json;
};

namespace schema_detail {
template <class... Answers>
struct Schema<Prebuilt<Answers...>> {
  static Json json(Schemas& schemas) {
    if constexpr (sizeof...(Answers) == 1) {
      return answer_schema<Answers...>(schemas);
    } else {
      Json choices = Json::array();
      (choices.push_back(answer_schema<Answers>(schemas)), ...);
      return {{"anyOf", std::move(choices)}};
    }
  }
};
}  // namespace schema_detail
}  // namespace signweave::wire

namespace signweave::answer_detail {
template <class Json, class... Answers>
struct Write<Json, wire::Prebuilt<Answers...>> {
  static Json json(const wire::Prebuilt<Answers...>& value) { return Json(value.json); }
};
}  // namespace signweave::answer_detail
