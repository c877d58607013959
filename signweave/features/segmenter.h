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

/// The phase of a hand at a moment, derived from motion alone.
enum class MotionPhase : std::uint8_t { rest = 0, preparation = 1, stroke = 2, hold = 3, retraction = 4 };
inline constexpr std::size_t kMotionPhases = 5;
std::string_view name_of(MotionPhase phase) noexcept;

/// The segmenter's input at one moment, in metres, whether captured by a suit, a Kinect or a camera. The axes are the
/// signer's, with an arbitrary origin: x to the signer's left, y up, z forward.
struct UpperBody {
  std::array<Eigen::Vector3f, 2> hands;   ///< [Side] palm or knuckles
  std::array<Eigen::Vector3f, 2> wrists;  ///< [Side]
  Eigen::Vector3f head;                   ///< its centre
  Eigen::Vector3f spine;                  ///< centre of the trunk
};

/// An upper body over time, as captured: at a fixed or variable rate, with or without gaps.
struct UpperBodyTrack {
  std::vector<Seconds> times;                  ///< ascending; a step of more than kLongestStep is a gap
  std::vector<UpperBody> bodies;               ///< one for each time
  std::array<bool, 2> has_hand{{true, true}};  ///< [Side] false: that hand's values are meaningless
};
inline constexpr Seconds kLongestStep{1.0};

/// One proposed phase of one hand, or of both together.
struct ProposedPhase {
  MotionPhase phase = MotionPhase::rest;
  Seconds begin{0};
  Seconds end{0};
  float confidence = 0;  ///< mean probability of the phase over its frames, in [0, 1]
};

/// The proposals for a recording.
struct ProposedPhases {
  std::array<std::vector<ProposedPhase>, 2> hands;  ///< [Side] in time order, without gaps except those of the capture
  std::vector<Notice> notices;                      ///< a hand that is absent
};

/// Proposes the phases of each hand separately, from motion alone, for manual checking. docs/segmenting.md describes
/// the method and its accuracy. Deterministic. Throws Error{bad_input} if times do not ascend, if their number differs
/// from that of the bodies, or if a value is not finite.
ProposedPhases propose_phases(const UpperBodyTrack& track);

/// Returns the upper body of a motion. Hands are the centre of the palm if the rig has knuckles, else the wrist. A hand
/// that the map lacks is absent (`has_hand`). Throws Error{not_found} if the map has neither hand, or lacks the head or
/// trunk as a reference.
UpperBodyTrack upper_body_of(const Motion& motion, const RigMap& rig);

}  // namespace signweave
