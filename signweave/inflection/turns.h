#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

/// Internal to this module.
namespace signweave::inflection {

/// An angle from -π to π.
inline float wrapped(float radians) {
  return std::remainder(radians, 2 * std::numbers::pi_v<float>);
}

/// Axis times angle, at most half a turn: q and -q are one rotation, of which the nearer half counts.
inline Eigen::Vector3f vector_of(const Eigen::Quaternionf& turn) {
  const float length = turn.vec().norm();
  if (length < 1e-9f) return Eigen::Vector3f::Zero();
  const float sign = turn.w() < 0 ? -1.0f : 1.0f;
  return sign * 2 * std::atan2(length, std::abs(turn.w())) / length * turn.vec();
}
inline Eigen::Quaternionf of_vector(const Eigen::Vector3f& turn) {
  const float angle = turn.norm();
  return angle < 1e-9f ? Eigen::Quaternionf::Identity() : Eigen::Quaternionf(Eigen::AngleAxisf(angle, turn / angle));
}

}  // namespace signweave::inflection
