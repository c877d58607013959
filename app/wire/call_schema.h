#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "signweave/calls/field.h"

namespace signweave::wire {

using calls::Field;

/// The schema of one field, except its type and default: help, values and bounds.
nlohmann::ordered_json schema_of(const Field& field);

/// Describes a call's fields as JSON Schema (2020-12, as used by OpenAPI 3.1).
class SchemaWriter {
 public:
  template <class Member>
  void operator()(const Field& field, const Member& member) {
    nlohmann::ordered_json schema = schema_of(field);
    if constexpr (std::is_same_v<Member, bool>) {
      schema["type"] = "boolean";
      schema["default"] = member;
    } else if constexpr (std::is_same_v<Member, std::string>) {
      schema["type"] = field.or_number ? nlohmann::ordered_json{"string", "number"} : nlohmann::ordered_json("string");
      if (field.shows_default) schema["default"] = member;
    } else if constexpr (std::is_same_v<Member, std::vector<std::string>>) {
      nlohmann::ordered_json items = {{"type", "string"}};
      if (schema.contains("enum")) items["enum"] = schema["enum"];
      schema.erase("enum");
      schema["type"] = "array";
      schema["items"] = std::move(items);
    } else if constexpr (std::is_same_v<Member, double> || std::is_same_v<Member, std::optional<double>>) {
      schema["type"] = "number";
      if constexpr (std::is_same_v<Member, double>) {
        if (field.shows_default) schema["default"] = member;
      }
    } else {
      schema["type"] = "integer";
      if constexpr (std::is_integral_v<Member>) {
        if (std::is_unsigned_v<Member> && !schema.contains("minimum")) schema["minimum"] = 0;
        if (field.shows_default) schema["default"] = member;
      }
    }
    if (!field.former.empty()) {
      nlohmann::ordered_json former = schema;
      former["description"] = "the former name of " + std::string(field.name);
      former["deprecated"] = true;
      properties[std::string(field.former)] = std::move(former);
    }
    properties[std::string(field.name)] = std::move(schema);
    if (field.required) required.push_back(std::string(field.name));
  }

  nlohmann::ordered_json properties = nlohmann::ordered_json::object();
  std::vector<std::string> required;
};

/// All fields of a call.
template <class Call>
SchemaWriter schema_of_call() {
  Call call;
  SchemaWriter writer;
  fields(writer, call);
  return writer;
}

}  // namespace signweave::wire
