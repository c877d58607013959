#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "signweave/features/capsule_row.h"
#include "signweave/features/hand_points.h"

namespace signweave {

/// The bones of the fingers of one hand as capsules, from the knuckle on: what can pass through another finger. The
/// thumb's first bone lies in the palm and is left out where more of the thumb is known. Reusable, so that a loop over
/// frames allocates nothing.
struct Phalanges {
  struct One {
    std::size_t first = 0;                             ///< of the finger's points, at which its first bone begins
    std::size_t begin = 0;                             ///< its bones in `bones`
    std::size_t end = 0;                               ///< not above `begin`: no such finger
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();  ///< of a ball about all of them
    float reach = 0;                                   ///< its radius, metres
  };
  std::array<One, kFingers.size()> fingers;                                       ///< [Finger]
  CapsuleRow bones;                                                               ///< of one finger after the other
  static_assert(kFingers.size() * (kFingerPoints - 1) - 1 <= CapsuleRow::kMost);  // the thumb lacks one
};

/// How thick the fingers are, metres: a tenth of their length from the knuckle to the tip, as that of an index finger
/// of 82 mm is thick where flesh gives. (ours) Bones do not grow, so one pose tells it for all.
using FingerRadii = std::array<float, kFingers.size()>;
FingerRadii finger_radii(const HandPoints& hand) noexcept;

void phalanges_of(const HandPoints& hand, const FingerRadii& radii, Phalanges& out) noexcept;

/// Two fingers of a hand, each pair once: of the first with the second to the fifth, of the second …
inline constexpr std::size_t kFingerPairs = kFingers.size() * (kFingers.size() - 1) / 2;
/// Where two fingers are nearest.
struct FingerPair {
  float depth = -1;          ///< metres, from surface to surface; below 0: apart; -1 where one of them is not there
  std::size_t a = 0, b = 0;  ///< the bones of both, in Phalanges::bones
  std::size_t finger_a = 0, finger_b = 0;
};
using FingerPairs = std::array<FingerPair, kFingerPairs>;  ///< [pair]
FingerPairs finger_pairs(const Phalanges& hand) noexcept;

/// How deep each pair is in each other where it is deepest, metres, at least 0. [pair]
using FingerDepths = std::array<float, kFingerPairs>;
FingerDepths finger_depths(const FingerPairs& pairs) noexcept;

/// Where two fingers are deeper in each other than is allowed.
struct FingerCrossing {
  float beyond = 0;  ///< metres deeper than allowed
  struct One {
    Finger finger = Finger::thumb;
    std::size_t bone = 0;                          ///< the point of the finger at which it begins
    Eigen::Vector3f at = Eigen::Vector3f::Zero();  ///< on its axis, metres, model space
  };
  One a, b;
  std::size_t pair = 0;
  Eigen::Vector3f away = Eigen::Vector3f::Zero();  ///< unit, leads a away from b; zero where the axes cross
};
/// The one that is farthest beyond; none where there is none.
std::optional<FingerCrossing> worst_crossing(const Phalanges& hand, const FingerPairs& pairs,
                                             const FingerDepths& allowed) noexcept;

}  // namespace signweave
