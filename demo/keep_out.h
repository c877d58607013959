#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>

#include "demo/signer.h"
#include "signweave/motion/kinematics.h"

namespace signweave::demo {

/// A capsule: a cylinder with round ends.
struct Capsule {
  Eigen::Vector3f from, to;  ///< metres
  float radius = 0;
};

/// The volumes hands must stay out of: trunk and head of a pose, model space.
std::array<Capsule, 2> keep_out_of(const Signer& signer, const ModelPose& pose);

/// Distance from the capsule's surface to a point, positive outside, negative inside.
float clearance(const Capsule& capsule, const Eigen::Vector3f& point);

/// The shift that moves points out of the capsules by the greatest penetration depth, with a soft onset before contact.
/// Smooth over time if the points are.
Eigen::Vector3f push_out(std::span<const Capsule> capsules, std::span<const Eigen::Vector3f> points);

/// The distance by which two hands, each given by points inside its bones, must be moved apart to leave room for the
/// fingers' thickness, with a soft onset. Metres.
float too_close(std::span<const Eigen::Vector3f> one, std::span<const Eigen::Vector3f> other);

}  // namespace signweave::demo
