#include "app/wire/call_schema.h"

namespace signweave::wire {

nlohmann::ordered_json schema_of(const Field& field) {
  nlohmann::ordered_json schema = {{"type", ""}, {"description", field.help}};
  if (field.is_file) schema["description"] = field.help + "; the name of a file of the same upload";
  if (!field.one_of.empty()) schema["enum"] = field.one_of;
  if (field.range) {
    std::visit([&](auto bound) { schema["minimum"] = bound; }, field.range->least);
    std::visit([&](auto bound) { schema["maximum"] = bound; }, field.range->most);
  }
  return schema;
}

}  // namespace signweave::wire
