#include "signweave/calls/rig_answer.h"

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

RigAnswer rig_answer(const Skeleton& skeleton, const RigMap& map) {
  RigAnswer answer{.convention = map.convention, .sides_swapped = map.sides_swapped, .parts = {}, .notices = {}};
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const PartPlace& place = map.places[i];
    if (!place.known()) continue;
    PartAnswer part{.joint = skeleton.joint(place.joint).name,
                    .index = place.joint,
                    .evidence = name_of(place.evidence),
                    .confidence = std::stod(fmt::format("{:.2f}", place.confidence)),
                    .offset = {}};
    if (!place.offset.isZero()) part.offset = {{place.offset.x(), place.offset.y(), place.offset.z()}};
    answer.parts.emplace_back(signweave::name_of(static_cast<Part>(i)), std::move(part));
  }
  for (const Notice& notice : map.notices) answer.notices.push_back(notice.text);
  return answer;
}

}  // namespace signweave::calls
