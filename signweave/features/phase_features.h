#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/core/bytes.h"
#include "signweave/features/hand_motion.h"

namespace signweave {

/// One hand at one end of a phase (the paper, section 4.2: position and direction at both ends).
struct HandAt {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< signer-centred, shoulder widths
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();  ///< metres a second, signer's axes
  Eigen::Vector3f palm = Eigen::Vector3f::Zero();      ///< unit; zero: no fingers
  Eigen::Vector3f fingers = Eigen::Vector3f::Zero();   ///< unit; zero: no fingers
  float openness = 0;
  Handshape handshape;
  Zone zone;
  Contact contact = Contact::none;
};

/// How one hand moves over a phase.
struct HandOver {
  static constexpr std::size_t kProfile = 16;
  bool known = false;                     ///< false: the rig lacks this hand, and everything below is zero
  HandAt begin;                           ///< at the first frame
  HandAt end;                             ///< at the last frame
  float path_length = 0;                  ///< metres
  float displacement = 0;                 ///< metres, straight from begin to end
  float mean_speed = 0;                   ///< metres a second
  float peak_speed = 0;                   ///< metres a second
  float peak_time = 0;                    ///< of the peak, in [0, 1] of the phase
  float mean_acceleration = 0;            ///< of its length; metres a second squared
  float mean_curvature = 0;               ///< 1/metre, weighted by speed
  std::array<float, kProfile> profile{};  ///< speed at equal steps from begin to end; metres a second
};

/// What is measured of one phase of a sign at import.
struct PhaseFeatures {
  float seconds = 0;
  bool known = false;              ///< false: nothing was measured (no signer space, no frame); `seconds` alone counts
  std::array<HandOver, 2> hands;   ///< [Side]
  float hands_distance_begin = 0;  ///< metres; 0 unless both hands are known
  float hands_distance_end = 0;
};

/// The number of the way of measuring: stored features of another version are measured anew.
inline constexpr std::uint16_t kFeatureVersion = 1;

/// The features over some frames of a motion, which may be empty (a phase shorter than a frame: then those of the frame
/// at its begin). `measured` must hold the frames.
PhaseFeatures features_over(const HandMotion& measured, FrameRange frames, FrameRate rate, const SignerBody& body);

}  // namespace signweave
