#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "signweave/core/time.h"

namespace signweave {

/// What a hand does at a moment, told from motion alone.
enum class MotionPhase : std::uint8_t { rest = 0, preparation = 1, stroke = 2, hold = 3, retraction = 4 };
inline constexpr std::size_t kMotionPhases = 5;
std::string_view name_of(MotionPhase phase) noexcept;

/// What the segmenter sees at one moment, in metres and any space whose y is up; captured by a suit, a Kinect or a
/// camera alike.
struct UpperBody {
  std::array<Eigen::Vector3f, 2> hands;   ///< [Side] palm or knuckles
  std::array<Eigen::Vector3f, 2> wrists;  ///< [Side]
  Eigen::Vector3f head;
  Eigen::Vector3f spine;  ///< middle of the trunk
};

/// One proposed stretch of one hand, or of both together.
struct ProposedPhase {
  MotionPhase phase = MotionPhase::rest;
  Seconds begin{0};
  Seconds end{0};
  float confidence = 0;  ///< mean probability of the phase over its frames, in [0, 1]
};

}  // namespace signweave
