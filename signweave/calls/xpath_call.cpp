#include "signweave/calls/xpath_call.h"

#include <charconv>
#include <cmath>

namespace signweave::calls {

std::vector<XPathAnswer> run(const Database& database, const XPathCall& call) {
  const xpath::Expression expression(call.expression);
  XPathLimits limits{.limit = {}, .deadline = {}, .recordings = call.recordings};
  if (call.limit > 0) limits.limit = call.limit;
  if (call.timeout_ms > 0) {
    limits.deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(call.timeout_ms);
  }
  return database.xpath(expression, limits);
}

std::vector<NodeAnswer> node_answers(const std::vector<XPathAnswer>& answers) {
  using Kind = xpath::Value::Kind;
  std::vector<NodeAnswer> list;
  for (const XPathAnswer& answer : answers) {
    const xpath::Value& value = answer.value;
    NodeAnswer one{
        .recording = answer.recording, .kind = name_of(value.kind), .name = {}, .value = value.value, .xml = {}};
    if (value.kind == Kind::boolean) one.value = value.value == "true";
    if (value.kind == Kind::number) {
      double number = 0;
      const char* end = value.value.data() + value.value.size();
      const auto [parsed, error] = std::from_chars(value.value.data(), end, number);
      one.value = null_unless(error == std::errc() && parsed == end && std::isfinite(number), number);
    }
    if (!value.name.empty()) one.name = value.name;
    if (value.kind < Kind::string) one.xml = value.xml;
    list.push_back(std::move(one));
  }
  return list;
}

std::vector<std::vector<std::string>> rows_of(const std::vector<XPathAnswer>& answers) {
  std::vector<std::vector<std::string>> rows = {{"recording", "answer"}};
  for (const XPathAnswer& answer : answers) rows.push_back({answer.recording, answer.value.xml});
  return rows;
}

}  // namespace signweave::calls
