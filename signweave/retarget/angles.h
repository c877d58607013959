#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

/// Internal to this module: angles, perpendicular components, and steps with smooth ends.
namespace signweave {

/// Returns 0 up to `from`, 1 past `to`, smooth in between.
inline float smooth_step(float value, float from, float to) noexcept {
  const float t = std::clamp((value - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// Returns 1 up to `from`, 0 past `to`, smooth in between.
inline float smooth_fall(float value, float from, float to) noexcept {
  return 1 - smooth_step(value, from, to);
}

/// Returns the component of a vector that is perpendicular to `axis`, which has length 1.
inline Eigen::Vector3f across(const Eigen::Vector3f& vector, const Eigen::Vector3f& axis) {
  return vector - vector.dot(axis) * axis;
}

/// Returns the angle between two vectors of any length, radians in [0, π].
inline float angle(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace signweave
