#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "signweave/core/answer.h"

/// Inside the library and its programs: answers (core/answer.h) as JSON.
namespace signweave {

/// The JSON of an answer. Json is nlohmann::json, which sorts the members of objects by name, or
/// nlohmann::ordered_json, which keeps the order of the description.
template <class Json = nlohmann::ordered_json, class Value>
Json answer_json(const Value& value);

template <class Json>
class AnswerJsonWriter {
 public:
  void type(std::string_view, std::string_view = {}) {}
  template <class Value>
  void operator()(const AnswerField& field, const Value& value) {
    object[std::string(field.name)] = answer_json<Json>(value);
  }
  template <class Value>
  void operator()(const AnswerField& field, const std::optional<Value>& value) {
    if (value) object[std::string(field.name)] = answer_json<Json>(*value);
  }

  Json object = Json::object();
};

namespace answer_detail {

template <class Json, class Value>
struct Write {
  static Json json(const Value& value) {
    if constexpr (std::is_arithmetic_v<Value> || std::is_convertible_v<Value, std::string_view>) {
      return Json(value);
    } else {
      AnswerJsonWriter<Json> writer;
      fields(writer, value);
      return std::move(writer.object);
    }
  }
};
template <class Json, class Value>
struct Write<Json, OrNull<Value>> {
  static Json json(const OrNull<Value>& value) { return value.value ? answer_json<Json>(*value.value) : Json(nullptr); }
};
template <class Json, class Value>
struct Write<Json, std::vector<Value>> {
  static Json json(const std::vector<Value>& values) {
    Json list = Json::array();
    for (const Value& value : values) list.push_back(answer_json<Json>(value));
    return list;
  }
};
template <class Json, class Value, std::size_t Count>
struct Write<Json, std::array<Value, Count>> {
  static Json json(const std::array<Value, Count>& values) {
    Json list = Json::array();
    for (const Value& value : values) list.push_back(answer_json<Json>(value));
    return list;
  }
};
template <class Json, class Value>
struct Write<Json, std::map<std::string, Value>> {
  static Json json(const std::map<std::string, Value>& values) {
    Json object = Json::object();
    for (const auto& [name, value] : values) object[name] = answer_json<Json>(value);
    return object;
  }
};
/// Pairs of names and values, in their order: an object.
template <class Json, class Value>
struct Write<Json, std::vector<std::pair<std::string, Value>>> {
  static Json json(const std::vector<std::pair<std::string, Value>>& values) {
    Json object = Json::object();
    for (const auto& [name, value] : values) object[name] = answer_json<Json>(value);
    return object;
  }
};
template <class Json, class... Values>
struct Write<Json, std::variant<Values...>> {
  static Json json(const std::variant<Values...>& value) {
    return std::visit([](const auto& one) { return answer_json<Json>(one); }, value);
  }
};

}  // namespace answer_detail

template <class Json, class Value>
Json answer_json(const Value& value) {
  return answer_detail::Write<Json, Value>::json(value);
}

}  // namespace signweave
