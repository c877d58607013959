#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "signweave/features/capsule_row.h"
#include "signweave/features/hand_points.h"

namespace signweave {

/// The finger bones of one hand as capsules, from the knuckle on: the parts that can pass through another finger. The
/// thumb's first bone lies in the palm and is omitted if more of the thumb is known. Reusable, so that a loop over
/// frames allocates nothing.
struct Phalanges {
  struct One {
    std::size_t first = 0;                             ///< index of the finger's point at which its first bone begins
    std::size_t begin = 0;                             ///< first of its bones in `bones`
    std::size_t end = 0;                               ///< one past the last; equal to `begin`: no such finger
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();  ///< centre of a sphere around all of them
    float reach = 0;                                   ///< radius of that sphere, metres
  };
  std::array<One, kFingers.size()> fingers;                                       ///< [Finger]
  CapsuleRow bones;                                                               ///< grouped by finger
  static_assert(kFingers.size() * (kFingerPoints - 1) - 1 <= CapsuleRow::kMost);  // the thumb lacks one
};

/// Radii of the fingers, metres: a tenth of the length from knuckle to tip, which matches an index finger of 82 mm
/// where soft tissue yields. (ours) Bones do not grow, so one pose determines it for all.
using FingerRadii = std::array<float, kFingers.size()>;
FingerRadii finger_radii(const HandPoints& hand) noexcept;

void phalanges_of(const HandPoints& hand, const FingerRadii& radii, Phalanges& out) noexcept;

/// Number of pairs of fingers, each pair once: first with second to fifth, second with third to fifth, and so on.
inline constexpr std::size_t kFingerPairs = kFingers.size() * (kFingers.size() - 1) / 2;
/// The closest point of two fingers.
struct FingerPair {
  float depth = -1;          ///< penetration depth of the surfaces, metres; negative: apart; -1 if a finger is missing
  std::size_t a = 0, b = 0;  ///< indices of both bones in Phalanges::bones
  std::size_t finger_a = 0, finger_b = 0;
};
using FingerPairs = std::array<FingerPair, kFingerPairs>;  ///< [pair]
FingerPairs finger_pairs(const Phalanges& hand) noexcept;

/// The maximum penetration depth of each pair, metres, at least 0. [pair]
using FingerDepths = std::array<float, kFingerPairs>;
FingerDepths finger_depths(const FingerPairs& pairs) noexcept;

/// Two fingers that penetrate each other more than is allowed.
struct FingerCrossing {
  float beyond = 0;  ///< metres deeper than allowed
  struct One {
    Finger finger = Finger::thumb;
    std::size_t bone = 0;                          ///< index of the finger's point at which the bone begins
    Eigen::Vector3f at = Eigen::Vector3f::Zero();  ///< point on its axis, metres, model space
  };
  One a, b;
  std::size_t pair = 0;
  Eigen::Vector3f away = Eigen::Vector3f::Zero();  ///< unit vector that separates a from b; zero if the axes cross
};
/// Returns the crossing that most exceeds its allowed depth; nullopt if none does.
std::optional<FingerCrossing> worst_crossing(const Phalanges& hand, const FingerPairs& pairs,
                                             const FingerDepths& allowed) noexcept;

}  // namespace signweave
