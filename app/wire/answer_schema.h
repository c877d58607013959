#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "signweave/core/answer.h"

namespace signweave::wire {

/// The named schemas of a document: {"Notice": {…}, …}.
using Schemas = nlohmann::ordered_json;

/// The schema of a type of answer (core/answer.h), JSON Schema 2020-12 as used by OpenAPI 3.1. The schema of a type
/// with a name goes to `schemas`, and what is returned refers to it. Members that may come with a later version are
/// allowed.
template <class Value>
nlohmann::ordered_json answer_schema(Schemas& schemas);

class AnswerSchemaWriter {
 public:
  explicit AnswerSchemaWriter(Schemas& schemas) : schemas_(&schemas) {}

  void type(std::string_view type_name, std::string_view type_help = {}) {
    name = type_name;
    help = type_help;
  }
  template <class Value>
  void operator()(const AnswerField& field, const Value&) {
    add(field, answer_schema<Value>(*schemas_));
    required.push_back(std::string(field.name));
  }
  template <class Value>
  void operator()(const AnswerField& field, const std::optional<Value>&) {
    add(field, answer_schema<Value>(*schemas_));
  }

  std::string name;  ///< of the type; empty: none
  std::string help;
  nlohmann::ordered_json properties = nlohmann::ordered_json::object();
  std::vector<std::string> required;

 private:
  void add(const AnswerField& field, nlohmann::ordered_json schema);
  Schemas* schemas_;
};

/// The schema of an object with these members. With a name it is stored in `schemas`, and a reference is returned.
nlohmann::ordered_json schema_of(const AnswerSchemaWriter& writer, Schemas& schemas);

namespace schema_detail {

using Json = nlohmann::ordered_json;

template <class Value>
struct Schema {
  static Json json(Schemas& schemas) {
    if constexpr (std::is_same_v<Value, bool>) {
      return {{"type", "boolean"}};
    } else if constexpr (std::is_integral_v<Value>) {
      return {{"type", "integer"}};
    } else if constexpr (std::is_floating_point_v<Value>) {
      return {{"type", "number"}};
    } else if constexpr (std::is_convertible_v<Value, std::string_view>) {
      return {{"type", "string"}};
    } else {
      AnswerSchemaWriter writer(schemas);
      fields(writer, Value());
      return schema_of(writer, schemas);
    }
  }
};
template <class Value>
struct Schema<OrNull<Value>> {
  static Json json(Schemas& schemas) {
    Json schema = answer_schema<Value>(schemas);
    if (!schema.contains("type")) {
      Json choices = Json::array();
      choices.push_back(std::move(schema));
      choices.push_back(Json{{"type", "null"}});
      return {{"oneOf", std::move(choices)}};
    }
    Json types = Json::array();
    types.push_back(schema["type"]);
    types.push_back("null");
    schema["type"] = std::move(types);
    return schema;
  }
};
template <class Value>
struct Schema<std::vector<Value>> {
  static Json json(Schemas& schemas) { return {{"type", "array"}, {"items", answer_schema<Value>(schemas)}}; }
};
template <class Value, std::size_t Count>
struct Schema<std::array<Value, Count>> {
  static Json json(Schemas& schemas) {
    return {{"type", "array"}, {"items", answer_schema<Value>(schemas)}, {"minItems", Count}, {"maxItems", Count}};
  }
};
template <class Value>
struct Schema<std::map<std::string, Value>> {
  static Json json(Schemas& schemas) {
    return {{"type", "object"}, {"additionalProperties", answer_schema<Value>(schemas)}};
  }
};
template <class Value>
struct Schema<std::vector<std::pair<std::string, Value>>> : Schema<std::map<std::string, Value>> {};
template <class... Values>
struct Schema<std::variant<Values...>> {
  static Json json(Schemas& schemas) {
    Json choices = Json::array();
    (choices.push_back(answer_schema<Values>(schemas)), ...);
    return {{"oneOf", std::move(choices)}};
  }
};

}  // namespace schema_detail

template <class Value>
nlohmann::ordered_json answer_schema(Schemas& schemas) {
  return schema_detail::Schema<Value>::json(schemas);
}

}  // namespace signweave::wire
