#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "signweave/features/hand_points.h"
#include "signweave/rig/signer_space.h"

namespace signweave {

/// A capsule: all points within `radius` of a line segment.
struct Capsule {
  Eigen::Vector3f from = Eigen::Vector3f::Zero();  ///< metres, model space
  Eigen::Vector3f to = Eigen::Vector3f::Zero();
  float radius = 0;  ///< metres
};
/// Returns the distance between the surfaces, metres; negative if they overlap.
float clearance(const Capsule& a, const Capsule& b) noexcept;

/// The clearance, and the direction that separates `a` from `b`, measured where the axes are closest.
struct Approach {
  float clearance = 0;
  Eigen::Vector3f away = Eigen::Vector3f::Zero();  ///< unit vector from b to a; zero if the axes cross
  float along_a = 0;                               ///< position of the closest point: 0 at a.from, 1 at a.to
  float along_b = 0;
};
Approach approach(const Capsule& a, const Capsule& b) noexcept;

// The sizes below are fractions of the body's own sizes, so that contact is detected alike for tall and short signers
// (docs/signing-space.md has a drawing). All values are ours, for a body of 1.70 m whose shoulder joints are 0.35 m
// apart.

/// Distances below this count as contact: soft tissue yields, and captures are inexact. Shoulder widths (1.4 cm).
inline constexpr float kContactGap = 0.04f;

/// One hand: a capsule from the wrist to each knuckle and two along each finger; without fingers, one capsule that
/// continues the forearm. Reusable, so that a loop over frames allocates nothing.
struct HandShell {
  static constexpr std::size_t kMostBars = 3 * kFingers.size();
  std::array<Capsule, kMostBars> bars;
  std::size_t count = 0;
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();  ///< centre of a sphere around all of them
  float reach = 0;                                   ///< radius of that sphere, metres

  std::span<const Capsule> all() const noexcept { return {bars.data(), count}; }
};
/// `elbow` is used only if there are no fingers.
HandShell shell_of(const HandPoints& hand, const std::optional<Eigen::Vector3f>& elbow,
                   const SignerBody& body) noexcept;

/// The forearm as one capsule from the elbow to the wrist; its radius is between those at the elbow and at the wrist.
Capsule forearm_bar(const Eigen::Vector3f& elbow, const Eigen::Vector3f& wrist, const SignerBody& body) noexcept;

/// Capsules of trunk and head in one pose.
struct BodyShell {
  std::array<Capsule, 2> torso;  ///< side by side, because a trunk is wider than deep
  std::optional<Capsule> head;   ///< nullopt if the rig has no head
};
BodyShell shell_of(const SignerBody& body, const RigMap& rig, const SignerSpace& space, const ModelPose& pose) noexcept;

/// The approach of the hand's nearest capsule to the other shape, as seen from the first argument. If a sphere around
/// the hand is clear of the other shape, `clearance` is only a lower bound and `away` is zero.
Approach approach(const HandShell& hand, const Capsule& other) noexcept;
Approach approach(const HandShell& a, const HandShell& b) noexcept;

/// Returns whether any capsule of the hand is within kContactGap of the other shape.
bool touches(const HandShell& hand, const Capsule& other, const SignerBody& body) noexcept;
bool touches(const HandShell& a, const HandShell& b, const SignerBody& body) noexcept;

}  // namespace signweave
