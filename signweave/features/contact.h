#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "signweave/features/hand_points.h"
#include "signweave/rig/signer_space.h"

namespace signweave {

/// A round bar: all within `radius` of a line.
struct Capsule {
  Eigen::Vector3f from = Eigen::Vector3f::Zero();  ///< metres, model space
  Eigen::Vector3f to = Eigen::Vector3f::Zero();
  float radius = 0;  ///< metres
};
/// From surface to surface, metres; below 0 where they overlap.
float clearance(const Capsule& a, const Capsule& b) noexcept;

/// The same, and which way leads `a` away from `b`: from axis to axis where they are nearest.
struct Approach {
  float clearance = 0;
  Eigen::Vector3f away = Eigen::Vector3f::Zero();  ///< unit; zero where the axes cross
  float along_a = 0;                               ///< where that is: 0 at a.from, 1 at a.to
  float along_b = 0;
};
Approach approach(const Capsule& a, const Capsule& b) noexcept;

// The sizes below are shares of the body's own, so that a tall and a small signer touch alike (docs/signing-space.md
// has them in a drawing). All are ours, for a body of 1.70 m whose shoulders' joints are 0.35 m apart.

/// Nearer than this counts as touching: what flesh gives and capture is off. Shoulder widths. (1.4 cm)
inline constexpr float kContactGap = 0.04f;

/// One hand: a bar from the wrist to each knuckle and two along each finger; without fingers one bar that goes on from
/// the forearm. Reusable, so that a loop over frames allocates nothing.
struct HandShell {
  static constexpr std::size_t kMostBars = 3 * kFingers.size();
  std::array<Capsule, kMostBars> bars;
  std::size_t count = 0;
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();  ///< of a ball about all of them
  float reach = 0;                                   ///< its radius, metres

  std::span<const Capsule> all() const noexcept { return {bars.data(), count}; }
};
/// `elbow` is looked at where there are no fingers.
HandShell shell_of(const HandPoints& hand, const std::optional<Eigen::Vector3f>& elbow,
                   const SignerBody& body) noexcept;

/// From the elbow to the wrist: neither as thick as a forearm is below the elbow nor as thin as at the wrist.
Capsule forearm_bar(const Eigen::Vector3f& elbow, const Eigen::Vector3f& wrist, const SignerBody& body) noexcept;

/// Trunk and head of one pose.
struct BodyShell {
  std::array<Capsule, 2> torso;  ///< side by side: a trunk is broader than deep
  std::optional<Capsule> head;   ///< none where the rig has no head
};
BodyShell shell_of(const SignerBody& body, const RigMap& rig, const SignerSpace& space, const ModelPose& pose) noexcept;

/// Whether any bar of a hand touches.
bool touches(const HandShell& hand, const Capsule& other, const SignerBody& body) noexcept;
bool touches(const HandShell& a, const HandShell& b, const SignerBody& body) noexcept;

}  // namespace signweave
