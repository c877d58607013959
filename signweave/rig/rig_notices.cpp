#include "signweave/rig/rig_notices.h"

#include <fmt/format.h>

#include <algorithm>

namespace signweave {
namespace {

using enum Part;

constexpr std::string_view kSideNames[] = {"left", "right"};

/// Reports missing parts: "one arm: no left arm" for a missing limb, "no left_forearm" for a part of one.
void report_limb(const RigMap& map, std::string_view limb, std::initializer_list<Part> left_parts,
                 std::vector<std::string>& out) {
  std::vector<std::string> missing[2];
  bool whole[2];
  for (const Side side : kSides) {
    const auto i = static_cast<std::size_t>(side);
    whole[i] = true;
    for (const Part left : left_parts) {
      if (map.has(of(side, left))) {
        whole[i] = false;
      } else {
        missing[i].emplace_back(name_of(of(side, left)));
      }
    }
  }
  if (whole[0] && whole[1]) {
    out.push_back(fmt::format("no {}s", limb));
    return;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    if (whole[i]) out.push_back(fmt::format("one {0}: no {1} {0}", limb, kSideNames[i]));
    if (!whole[i] && !missing[i].empty()) out.push_back(fmt::format("no {}", fmt::join(missing[i], ", no ")));
  }
}

std::size_t fingers_at(const RigMap& map, Side side) {
  return static_cast<std::size_t>(std::count_if(kFingers.begin(), kFingers.end(), [&](Finger finger) {
    return map.has(finger_part(side, finger, FingerPoint::proximal));
  }));
}

/// Returns "no ring, little finger"; empty if all fingers are present.
std::string missing_fingers(const RigMap& map, Side side) {
  if (fingers_at(map, side) == 0) return "no fingers";
  constexpr std::string_view kFingerNames[] = {"thumb", "index", "middle", "ring", "little"};
  std::vector<std::string_view> missing;
  for (const Finger finger : kFingers) {
    if (map.has(finger_part(side, finger, FingerPoint::proximal))) continue;
    missing.push_back(kFingerNames[static_cast<std::size_t>(finger)]);
  }
  if (missing.empty()) return {};
  return fmt::format("no {}{}", fmt::join(missing, ", "), missing.back() == "thumb" ? "" : " finger");
}

}  // namespace

std::vector<std::string> missing_parts(const RigMap& map) {
  const auto known = [](const PartPlace& place) { return place.known(); };
  if (std::none_of(map.places.begin(), map.places.end(), known)) {
    return {"no body: neither names nor shape identify any part; a mapping file can"};
  }
  std::vector<std::string> out;
  for (const Part part : {pelvis, chest, neck, head}) {
    if (!map.has(part)) out.push_back(fmt::format("no {}", name_of(part)));
  }
  report_limb(map, "arm", {left_upper_arm, left_forearm, left_hand}, out);
  report_limb(map, "leg", {left_thigh, left_shin, left_foot}, out);
  const std::size_t fingers[] = {fingers_at(map, Side::left), fingers_at(map, Side::right)};
  const bool hands[] = {map.has(left_hand), map.has(right_hand)};
  if (fingers[0] + fingers[1] == 0) {
    if (hands[0] || hands[1]) out.emplace_back("no fingers");
    return out;
  }
  const std::string missing[] = {hands[0] ? missing_fingers(map, Side::left) : "",
                                 hands[1] ? missing_fingers(map, Side::right) : ""};
  if (missing[0] == missing[1] && !missing[0].empty()) {
    out.push_back(fmt::format("both hands: {}", missing[0]));
    return out;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    if (!missing[i].empty()) out.push_back(fmt::format("{} hand: {}", kSideNames[i], missing[i]));
  }
  return out;
}

}  // namespace signweave
