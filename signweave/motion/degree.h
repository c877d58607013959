#pragma once

#include <numbers>

namespace signweave {

inline constexpr float kDegree = std::numbers::pi_v<float> / 180;  ///< in radians

}  // namespace signweave
