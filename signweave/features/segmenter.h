#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/motion/motion.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

/// What a hand does at a moment, told from motion alone.
enum class MotionPhase : std::uint8_t { rest = 0, preparation = 1, stroke = 2, hold = 3, retraction = 4 };
inline constexpr std::size_t kMotionPhases = 5;
std::string_view name_of(MotionPhase phase) noexcept;

/// What the segmenter sees at one moment, in metres: captured by a suit, a Kinect or a camera alike. The axes are the
/// signer's, the origin anywhere: x to the signer's left, y up, z forward.
struct UpperBody {
  std::array<Eigen::Vector3f, 2> hands;   ///< [Side] palm or knuckles
  std::array<Eigen::Vector3f, 2> wrists;  ///< [Side]
  Eigen::Vector3f head;                   ///< its middle
  Eigen::Vector3f spine;                  ///< middle of the trunk
};

/// An upper body over time, as captured: at a fixed rate or not, with gaps or without.
struct UpperBodyTrack {
  std::vector<Seconds> times;                  ///< ascending; a step of more than kLongestStep is a gap
  std::vector<UpperBody> bodies;               ///< one for each time
  std::array<bool, 2> has_hand{{true, true}};  ///< [Side] false: that hand's numbers mean nothing
};
inline constexpr Seconds kLongestStep{1.0};

/// One proposed stretch of one hand, or of both together.
struct ProposedPhase {
  MotionPhase phase = MotionPhase::rest;
  Seconds begin{0};
  Seconds end{0};
  float confidence = 0;  ///< mean probability of the phase over its frames, in [0, 1]
};

/// What is proposed for a recording.
struct ProposedPhases {
  std::array<std::vector<ProposedPhase>, 2>
      hands;                    ///< [Side] in time order, without gaps but where the capture has them
  std::vector<Notice> notices;  ///< a hand that is absent
};

/// Phases of both hands, each for itself, from motion alone: proposals for a person to check. docs/segmenting.md says
/// how, and how good they are. Deterministic. Throws Error{bad_input} where times do not ascend or are not as many as
/// bodies, and where a number is not finite.
ProposedPhases propose_phases(const UpperBodyTrack& track);

/// The upper body of a motion. Hands are the middle of the palm where the rig has knuckles, else the wrist. A hand
/// that the map lacks is absent (`has_hand`). Throws Error{not_found} where the map has neither hand, or no head or
/// trunk to measure them by.
UpperBodyTrack upper_body_of(const Motion& motion, const RigMap& rig);

}  // namespace signweave
