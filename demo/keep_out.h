#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>

#include "demo/signer.h"
#include "signweave/motion/kinematics.h"

namespace signweave::demo {

/// A round bar.
struct Capsule {
  Eigen::Vector3f from, to;  ///< metres
  float radius = 0;
};

/// Where hands cannot go: trunk and head of a pose, model space.
std::array<Capsule, 2> keep_out_of(const Signer& signer, const ModelPose& pose);

/// From the capsule's surface to a point, outwards; negative inside.
float clearance(const Capsule& capsule, const Eigen::Vector3f& point);

/// The shift that takes points out of the capsules as far as the deepest is in, with a soft beginning before they
/// touch. Smooth over time where the points are.
Eigen::Vector3f push_out(std::span<const Capsule> capsules, std::span<const Eigen::Vector3f> points);

/// How far two hands, each given by points within its bones, must be moved apart for the fingers' thickness, with a
/// soft beginning. Metres.
float too_close(std::span<const Eigen::Vector3f> one, std::span<const Eigen::Vector3f> other);

}  // namespace signweave::demo
