#include "app/wire/tier_changes.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/wire/call_schema.h"
#include "app/wire/read.h"

namespace signweave::wire {
namespace {

using calls::NewTier;
using calls::TierChanges;
using nlohmann::json;

struct LabelledSpan {
  std::int64_t begin_ms = 0;
  std::int64_t end_ms = 0;
  std::string label;
};

template <class Visit>
void fields(Visit& visit, LabelledSpan& one) {
  visit(Field{.name = "begin_ms", .help = "annotation time", .required = true}, one.begin_ms);
  visit(Field{.name = "end_ms", .help = "annotation time", .required = true}, one.end_ms);
  visit(Field{.name = "label", .help = "the text of the annotation", .required = true}, one.label);
}

struct PropertyValue {
  std::string name;
  std::string value;
};

template <class Visit>
void fields(Visit& visit, PropertyValue& property) {
  visit(Field{.name = "name", .help = "name of the property", .required = true}, property.name);
  visit(Field{.name = "value", .help = "its value", .required = true}, property.value);
}

/// Takes a list out of an object; empty if it has none.
json take_list(json& object, const std::string& name) {
  const auto at = object.find(name);
  if (at == object.end()) return json::array();
  json list = std::move(*at);
  object.erase(at);
  if (!list.is_array()) throw Error(ErrorCode::bad_input, name + ": expected a list");
  return list;
}

/// Reads an object of a list; errors begin with its position, such as "tiers[0].".
template <class Part>
Part read_part(const json& object, const std::string& where) {
  try {
    return read_call<Part>(object);
  } catch (const Error& error) {
    throw Error(error.code(), where + error.what());
  }
}

NewTier read_tier(json object, const std::string& where) {
  const json annotations = object.is_object() ? take_list(object, "annotations") : json::array();
  auto tier = read_part<NewTier>(object, where + '.');
  for (std::size_t k = 0; k < annotations.size(); ++k) {
    auto one = read_part<LabelledSpan>(annotations[k], fmt::format("{}.annotations[{}].", where, k));
    Annotation annotation;
    annotation.label = std::move(one.label);
    annotation.span = {Milliseconds(one.begin_ms), Milliseconds(one.end_ms)};
    tier.annotations.push_back(std::move(annotation));
  }
  return tier;
}

nlohmann::ordered_json object_schema(const SchemaWriter& writer) {
  return {{"type", "object"}, {"required", writer.required}, {"properties", writer.properties}};
}

nlohmann::ordered_json list_schema(nlohmann::ordered_json items) {
  return {{"type", "array"}, {"items", std::move(items)}};
}

}  // namespace

TierChanges tier_changes_from_json(std::string_view text) {
  json body = parse_body(text);
  if (!body.is_object()) throw Error(ErrorCode::bad_input, "expected a JSON object, such as {\"tiers\": […]}");
  const json tiers = take_list(body, "tiers");
  const json properties = take_list(body, "properties");
  TierChanges changes;
  const Texts none;  // borrowed by the reader
  FieldReader rest(std::move(body), none);
  rest(Field{.name = "remove", .help = "names of tiers"}, changes.remove);
  rest.finish();
  for (std::size_t k = 0; k < tiers.size(); ++k) {
    changes.tiers.push_back(read_tier(tiers[k], fmt::format("tiers[{}]", k)));
  }
  for (std::size_t k = 0; k < properties.size(); ++k) {
    auto property = read_part<PropertyValue>(properties[k], fmt::format("properties[{}].", k));
    changes.properties.emplace_back(std::move(property.name), std::move(property.value));
  }
  return changes;
}

nlohmann::ordered_json tier_changes_schema() {
  nlohmann::ordered_json tier = object_schema(schema_of_call<NewTier>());
  tier["required"].push_back("annotations");
  tier["properties"]["annotations"] = list_schema(object_schema(schema_of_call<LabelledSpan>()));
  nlohmann::ordered_json remove = list_schema({{"type", "string"}});
  remove["description"] = "names of tiers that are removed before others are added";
  return {{"type", "object"},
          {"properties",
           {{"remove", std::move(remove)},
            {"tiers", list_schema(std::move(tier))},
            {"properties", list_schema(object_schema(schema_of_call<PropertyValue>()))}}}};
}

}  // namespace signweave::wire
