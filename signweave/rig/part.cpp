#include "signweave/rig/part.h"

#include <string>
#include <vector>

namespace signweave {
namespace {

constexpr std::array<std::string_view, kNamedParts> kNames = {
    "pelvis",
    "spine",
    "chest",
    "neck",
    "head",
    "head_top",
    "jaw",
    "left_eye",
    "right_eye",
    "left_clavicle",
    "right_clavicle",
    "left_upper_arm",
    "right_upper_arm",
    "left_forearm",
    "right_forearm",
    "left_hand",
    "right_hand",
    "left_thigh",
    "right_thigh",
    "left_shin",
    "right_shin",
    "left_foot",
    "right_foot",
    "left_toes",
    "right_toes",
};

/// [part] the names; those of fingers are composed of side, finger and point.
const std::vector<std::string>& names() {
  static const std::vector<std::string> list = [] {
    std::vector<std::string> all(kNames.begin(), kNames.end());
    for (const char* side : {"left_", "right_"}) {
      for (const char* finger : {"thumb_", "index_", "middle_", "ring_", "little_"}) {
        for (const char* point : {"metacarpal", "proximal", "intermediate", "distal", "tip"}) {
          all.push_back(std::string(side).append(finger).append(point));
        }
      }
    }
    return all;
  }();
  return list;
}

}  // namespace

std::string_view name_of(Part part) noexcept {
  return names()[static_cast<std::size_t>(part)];
}

std::optional<Part> part_named(std::string_view name) noexcept {
  for (std::size_t i = 0; i < kPartCount; ++i) {
    if (names()[i] == name) return static_cast<Part>(i);
  }
  return std::nullopt;
}

}  // namespace signweave
