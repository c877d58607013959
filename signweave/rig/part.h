#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace signweave {

enum class Side : std::uint8_t { left = 0, right = 1 };  ///< the signer's side
inline constexpr std::array kSides = {Side::left, Side::right};
constexpr std::string_view name_of(Side side) noexcept {
  return side == Side::left ? "left" : "right";
}

enum class Finger : std::uint8_t { thumb = 0, index = 1, middle = 2, ring = 3, little = 4 };
inline constexpr std::array kFingers = {Finger::thumb, Finger::index, Finger::middle, Finger::ring, Finger::little};

/// The points of a finger, from the wrist outwards. A thumb has no separate metacarpal here: its first joint is the one
/// near the wrist (carpometacarpal), its second the metacarpophalangeal, its third the interphalangeal.
enum class FingerPoint : std::uint8_t {
  metacarpal = 0,    ///< inside the palm; missing in many rigs
  proximal = 1,      ///< the knuckle, where the finger leaves the palm
  intermediate = 2,  ///< the second joint
  distal = 3,        ///< the third joint
  tip = 4,           ///< the end of the finger
};
inline constexpr std::size_t kFingerPoints = 5;

/// A part of the body, identified by the joint at which it begins: `left_forearm` is the left elbow and `left_hand` the
/// left wrist. Stored on disk: never renumber. Fingers follow the named parts: see `finger_part`.
enum class Part : std::uint8_t {
  pelvis = 0,
  spine = 1,  ///< the first joint above the pelvis that bends the trunk
  chest = 2,  ///< the joint from which neck and clavicles grow
  neck = 3,
  head = 4,
  head_top = 5,  ///< the end of the head
  jaw = 6,
  left_eye = 7,
  right_eye = 8,
  left_clavicle = 9,
  right_clavicle = 10,
  left_upper_arm = 11,  ///< the shoulder
  right_upper_arm = 12,
  left_forearm = 13,  ///< the elbow
  right_forearm = 14,
  left_hand = 15,  ///< the wrist
  right_hand = 16,
  left_thigh = 17,  ///< the hip
  right_thigh = 18,
  left_shin = 19,  ///< the knee
  right_shin = 20,
  left_foot = 21,  ///< the ankle
  right_foot = 22,
  left_toes = 23,
  right_toes = 24,
  left_thumb_metacarpal = 25,  ///< then metacarpal … tip of the left thumb, index, …; then the right hand
};
inline constexpr std::size_t kNamedParts = 25;
inline constexpr std::size_t kPartCount = kNamedParts + 2 * kFingers.size() * kFingerPoints;

constexpr Part finger_part(Side side, Finger finger, FingerPoint point) noexcept {
  const std::size_t row = static_cast<std::size_t>(side) * kFingers.size() + static_cast<std::size_t>(finger);
  return static_cast<Part>(kNamedParts + row * kFingerPoints + static_cast<std::size_t>(point));
}

/// The counterpart of `left` on a side: of(Side::right, Part::left_hand) is right_hand. `left` must be one of the named
/// left parts.
constexpr Part of(Side side, Part left) noexcept {
  return static_cast<Part>(static_cast<std::uint8_t>(left) + static_cast<std::uint8_t>(side));
}

/// "pelvis", "left_hand", "right_index_proximal", …: the names used in mapping files and reports.
std::string_view name_of(Part part) noexcept;
std::optional<Part> part_named(std::string_view name) noexcept;

}  // namespace signweave
