#include "app/wire/answer_schema.h"

namespace signweave::wire {

using Json = nlohmann::ordered_json;

void AnswerSchemaWriter::add(const AnswerField& field, Json schema) {
  if (!field.one_of.empty()) {
    schema["enum"] = Json::array();
    for (const std::string_view value : field.one_of) schema["enum"].push_back(value);
  }
  if (field.minimum) schema["minimum"] = *field.minimum;
  if (field.maximum) schema["maximum"] = *field.maximum;
  if (!field.help.empty()) schema["description"] = field.help;
  properties[std::string(field.name)] = std::move(schema);
}

Json schema_of(const AnswerSchemaWriter& writer, Schemas& schemas) {
  Json schema = {{"type", "object"}};
  if (!writer.required.empty()) schema["required"] = writer.required;
  schema["properties"] = writer.properties;
  if (!writer.help.empty()) schema["description"] = writer.help;
  if (writer.name.empty()) return schema;
  schemas[writer.name] = std::move(schema);
  return {{"$ref", "#/components/schemas/" + writer.name}};
}

}  // namespace signweave::wire
