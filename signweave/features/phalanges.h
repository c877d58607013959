#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "signweave/features/contact.h"
#include "signweave/features/hand_points.h"

namespace signweave {

/// The bones of the fingers of one hand as capsules, from the knuckle on: what can pass through another finger. The
/// thumb's first bone lies in the palm and is left out where more of the thumb is known. Reusable, so that a loop over
/// frames allocates nothing.
struct Phalanges {
  static constexpr std::size_t kMost = kFingerPoints - 1;
  /// A capsule, as many others are held against it.
  struct Bone {
    Eigen::Vector3f from = Eigen::Vector3f::Zero();    ///< metres, model space
    Eigen::Vector3f along = Eigen::Vector3f::Zero();   ///< to its end
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();  ///< of a ball about it
    float square = 0;                                  ///< of its length
    float reach = 0;                                   ///< the ball's radius
    float radius = 0;
  };
  struct Row {
    std::array<Bone, kMost> bones;
    std::size_t first = 0;                             ///< of the finger's points, at which bone 0 begins
    std::size_t count = 0;                             ///< 0: no such finger
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();  ///< of a ball about all of them
    float reach = 0;                                   ///< its radius, metres
  };
  std::array<Row, kFingers.size()> fingers;  ///< [Finger]
};

/// How thick the fingers are, metres: a tenth of their length from the knuckle to the tip, as that of an index finger
/// of 82 mm is thick where flesh gives. (ours) Bones do not grow, so one pose tells it for all.
using FingerRadii = std::array<float, kFingers.size()>;
FingerRadii finger_radii(const HandPoints& hand) noexcept;

void phalanges_of(const HandPoints& hand, const FingerRadii& radii, Phalanges& out) noexcept;

/// Two fingers of a hand, each pair once: of the first with the second to the fifth, of the second …
inline constexpr std::size_t kFingerPairs = kFingers.size() * (kFingers.size() - 1) / 2;
/// How deep each pair is in each other where it is deepest, metres, at least 0. [pair]
using FingerDepths = std::array<float, kFingerPairs>;
FingerDepths finger_depths(const Phalanges& hand) noexcept;

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
/// The one that is farthest beyond, and beyond `least`; none where there is none.
std::optional<FingerCrossing> worst_crossing(const Phalanges& hand, const FingerDepths& allowed, float least) noexcept;

}  // namespace signweave
