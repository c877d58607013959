#include "app/calls/json.h"

namespace signweave::calls {

using nlohmann::json;

json json_of(const Remedies& remedies) {
  json list = json::array();
  for (const Remedy& remedy : remedies) {
    list.push_back({{"parameter", remedy.parameter}});
    if (!remedy.value.empty()) list.back()["value"] = remedy.value;
  }
  return list;
}

json json_of(const std::vector<Notice>& notices) {
  json list = json::array();
  for (const Notice& notice : notices) {
    list.push_back({{"where", notice.where}, {"text", notice.text}});
    if (!notice.remedies.empty()) list.back()["remedies"] = json_of(notice.remedies);
  }
  return list;
}

json declarations_json(const std::vector<std::pair<std::string, std::string>>& declarations) {
  json object = json::object();
  for (const auto& [name, value] : declarations) object[name] = value;
  return object;
}

json span_json(TimeSpan span) {
  return {{"begin_ms", span.begin.count()}, {"end_ms", span.end.count()}};
}

json frames_json(FrameRange frames) {
  return {{"begin", frames.begin}, {"end", frames.end}};
}

}  // namespace signweave::calls
