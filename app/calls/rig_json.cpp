#include "app/calls/rig_json.h"

#include <fmt/format.h>

namespace signweave::calls {

std::string_view name_of(Evidence evidence) {
  switch (evidence) {
    case Evidence::none:
      return "none";
    case Evidence::name:
      return "name";
    case Evidence::structure:
      return "shape";
    case Evidence::file:
      return "file";
  }
  return "none";
}

nlohmann::ordered_json json_of_rig(const Skeleton& skeleton, const RigMap& map) {
  nlohmann::ordered_json parts = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const PartPlace& place = map.places[i];
    if (!place.known()) continue;
    nlohmann::ordered_json one = {{"joint", skeleton.joint(place.joint).name},
                                  {"index", place.joint},
                                  {"evidence", name_of(place.evidence)},
                                  {"confidence", std::stod(fmt::format("{:.2f}", place.confidence))}};
    if (!place.offset.isZero()) one["offset"] = {place.offset.x(), place.offset.y(), place.offset.z()};
    parts[std::string(signweave::name_of(static_cast<Part>(i)))] = std::move(one);
  }
  nlohmann::ordered_json notices = nlohmann::ordered_json::array();
  for (const Notice& notice : map.notices) notices.push_back(notice.text);
  return {{"convention", map.convention},
          {"sides_swapped", map.sides_swapped},
          {"parts", std::move(parts)},
          {"notices", std::move(notices)}};
}

}  // namespace signweave::calls
