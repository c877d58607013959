#pragma once

#include <cstddef>
#include <numbers>

#include "signweave/motion/skeleton.h"
#include "signweave/rig/part.h"

/// Internal to this module.
namespace signweave::inflection {

inline constexpr float kDegree = std::numbers::pi_v<float> / 180;  ///< radians

/// Indexes into arrays.
constexpr std::size_t slot(Side side) noexcept {
  return static_cast<std::size_t>(side);
}
constexpr std::size_t slot(JointIndex joint) noexcept {
  return static_cast<std::size_t>(joint);
}
constexpr Side other(Side side) noexcept {
  return side == Side::left ? Side::right : Side::left;
}

}  // namespace signweave::inflection
