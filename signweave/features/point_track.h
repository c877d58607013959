#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/features/hand_motion.h"
#include "signweave/motion/motion.h"
#include "signweave/rig/part.h"

namespace signweave {

/// To which side of the signer a direction goes most. Stored on disk: never renumber.
enum class Facing : std::uint8_t {
  unknown = 0,  ///< of a hand without fingers
  up = 1,
  down = 2,
  left = 3,  ///< the signer's
  right = 4,
  forward = 5,
  back = 6,
};
Facing facing_of(const Eigen::Vector3f& direction) noexcept;

/// What a hand is like at one frame, beside where it is.
struct HandState {
  float openness = 0;  ///< 0 a fist to 1 a flat hand; 0 without fingers
  Contact contact = Contact::none;
  Facing palm = Facing::unknown;     ///< out of the palm
  Facing fingers = Facing::unknown;  ///< from the wrist to the middle knuckle
};

/// One point of a signer at one frame.
struct PointFrame {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< signer-centred, shoulder widths
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();  ///< metres a second, signer's axes, smoothed
  float acceleration = 0;                              ///< its length, metres a second squared, smoothed
  HandState state;                                     ///< of a palm only
};
using PointTrack = std::vector<PointFrame>;  ///< [frame - first]

PointFrame point_of(const HandFrame& hand) noexcept;

/// How a point moves over some frames.
struct PointOver {
  float peak_speed = 0;             ///< metres a second
  float mean_speed = 0;             ///< metres a second
  float peak_acceleration = 0;      ///< metres a second squared
  float mean_acceleration = 0;      ///< metres a second squared
  float path_length = 0;            ///< metres: speed summed over time
  float displacement = 0;           ///< metres, straight from begin to end, seen from the signer
  Contact contact = Contact::none;  ///< all that is touched at some frame
  PointFrame begin;                 ///< at the first frame
  PointFrame end;                   ///< at the last frame
};

/// Over at least one frame. The same numbers as `features_over` gives of a palm.
PointOver over(std::span<const PointFrame> frames, FrameRate rate, float shoulder_width) noexcept;

/// Tracks of points of the body over some frames (clamped to the motion), one for each part; empty where the rig lacks
/// it, and all where there is no signer-centred space. Frames beside the range are read for smoothing as in
/// `measure_hands`, so a part of a motion gives the same numbers as the whole, to the bit.
std::vector<PointTrack> track_points(const Motion& motion, const SignerModel& model, std::span<const Part> parts,
                                     FrameRange range);

}  // namespace signweave
