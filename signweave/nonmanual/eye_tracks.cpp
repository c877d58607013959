#include "signweave/nonmanual/eye_tracks.h"

#include <algorithm>
#include <array>

#include "signweave/motion/degree.h"

namespace signweave {
namespace {

// Degrees at weight 1, the values by which searches read gaze from weights (signweave/features/gaze.h).
constexpr float kAcross = 35;
constexpr float kDown = 35;
constexpr float kUp = 25;

/// What a track shows at 1, degrees of yaw and pitch: one of both is 0. Rotations count both directions.
struct EyeRow {
  std::string_view name;
  float yaw, pitch;
};
// Order: the weights of both eyes. "In" is towards the nose.
constexpr std::array kLooks = {
    EyeRow{"eyeLookInLeft", -kAcross, 0}, EyeRow{"eyeLookOutLeft", kAcross, 0},  EyeRow{"eyeLookUpLeft", 0, kUp},
    EyeRow{"eyeLookDownLeft", 0, -kDown}, EyeRow{"eyeLookInRight", kAcross, 0},  EyeRow{"eyeLookOutRight", -kAcross, 0},
    EyeRow{"eyeLookUpRight", 0, kUp},     EyeRow{"eyeLookDownRight", 0, -kDown},
};

}  // namespace

std::span<const std::string_view> look_tracks() noexcept {
  static constexpr auto kNames = [] {
    std::array<std::string_view, kLooks.size()> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = kLooks[i].name;
    return names;
  }();
  return kNames;
}

std::optional<float> eye_track_value(std::string_view track, GazeDirection eyes) noexcept {
  for (const EyeRow& row : kLooks) {
    if (row.name == track) {
      return std::clamp(row.yaw != 0 ? eyes.yaw / row.yaw : eyes.pitch / row.pitch, 0.0f, 1.0f);
    }
  }
  if (track == "leftEyeYaw" || track == "rightEyeYaw") return -std::clamp(eyes.yaw, -kAcross, kAcross) * kDegree;
  if (track == "leftEyePitch" || track == "rightEyePitch") return -std::clamp(eyes.pitch, -kDown, kUp) * kDegree;
  if (track == "leftEyeRoll" || track == "rightEyeRoll") return 0.0f;
  return std::nullopt;
}

}  // namespace signweave
