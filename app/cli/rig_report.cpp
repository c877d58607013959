#include "app/cli/rig_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "signweave/calls/table.h"
#include "signweave/core/text.h"

namespace signweave::cli {
namespace {

/// "LeftHand", or "LeftHandIndex3+" for a point that moves with that joint.
std::string place_name(const Skeleton& skeleton, const PartPlace& place) {
  if (!place.known()) return "-";
  return fmt::format("{}{}", printable(skeleton.joint(place.joint).name), place.offset.isZero() ? "" : "+");
}

/// "…2" for LeftHandIndex2 after LeftHandIndex1.
std::string shortened(const std::string& name, const std::string& before) {
  std::size_t same = 0;
  while (same < std::min(name.size(), before.size()) && name[same] == before[same]) ++same;
  while (same > 0 && (name[same] & 0xC0) == 0x80) --same;  // between characters, not within one
  if (same < 4 || name.size() - same > 3) return name;
  // A number is not split: Finger1, Finger11 -> Finger1 …11.
  while (same > 0 && name[same - 1] >= '0' && name[same - 1] <= '9') --same;
  return "…" + name.substr(same);
}

std::vector<std::string> row_of(std::string name, const std::vector<std::string>& joints,
                                const std::vector<PartPlace>& places) {
  float least = 1;
  std::string evidence;
  for (const PartPlace& place : places) {
    if (!place.known()) continue;
    least = std::min(least, place.confidence);
    const std::string_view one = name_of(place.evidence);
    if (evidence.find(one) == std::string::npos) evidence.append(evidence.empty() ? "" : ", ").append(one);
  }
  return {std::move(name), fmt::format("{}", fmt::join(joints, " ")), evidence, fmt::format("{:.2f}", least)};
}

}  // namespace

RigMap rig_map_of(const Motion& motion, const std::string& path) {
  if (path.empty()) return map_rig(motion);
  const RigNames names = read_rig_names(path);
  try {
    return map_rig(motion, names);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", path, error.what()), error.remedies());
  }
}

void print_rig(const Skeleton& skeleton, const RigMap& map, const std::string& where, Io& io) {
  io.out << fmt::format("rig: {}\n", map.convention.empty() ? "names of no known convention" : map.convention);
  std::vector<std::vector<std::string>> rows = {{"part", "joint", "evidence", "confidence"}};
  for (std::size_t i = 0; i < kNamedParts; ++i) {
    const auto part = static_cast<Part>(i);
    if (!map.has(part)) continue;
    rows.push_back(row_of(std::string(signweave::name_of(part)), {place_name(skeleton, map[part])}, {map[part]}));
  }
  for (const Side side : kSides) {
    for (const Finger finger : kFingers) {
      std::vector<std::string> joints;
      std::vector<PartPlace> places;
      for (std::size_t point = 0; point < kFingerPoints; ++point) {
        const PartPlace& place = map[finger_part(side, finger, static_cast<FingerPoint>(point))];
        if (!place.known()) continue;
        joints.push_back(
            shortened(place_name(skeleton, place), joints.empty() ? "" : place_name(skeleton, places.back())));
        places.push_back(place);
      }
      if (joints.empty()) continue;
      const std::string_view whole = signweave::name_of(finger_part(side, finger, FingerPoint::tip));
      rows.push_back(row_of(std::string(whole.substr(0, whole.size() - 4)), joints, places));
    }
  }
  if (rows.size() > 1) io.out << format_table(rows);
  std::vector<Notice> notices = map.notices;
  for (Notice& notice : notices) notice.where = where;
  print_notices(io, notices);
}

}  // namespace signweave::cli
