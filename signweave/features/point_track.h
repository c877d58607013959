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

/// The signer's axis that is nearest to a direction. Stored on disk: never renumber.
enum class Facing : std::uint8_t {
  unknown = 0,  ///< for a hand without fingers
  up = 1,
  down = 2,
  left = 3,  ///< the signer's
  right = 4,
  forward = 5,
  back = 6,
};
Facing facing_of(const Eigen::Vector3f& direction) noexcept;

/// The state of a hand at one frame, besides its position.
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
  float acceleration = 0;                              ///< magnitude, metres a second squared, smoothed
  HandState state;                                     ///< only set for a palm
};
using PointTrack = std::vector<PointFrame>;  ///< [frame - first]

PointFrame point_of(const HandFrame& hand) noexcept;

/// The movement of a point over some frames.
struct PointOver {
  float peak_speed = 0;             ///< metres a second
  float mean_speed = 0;             ///< metres a second
  float peak_acceleration = 0;      ///< metres a second squared
  float mean_acceleration = 0;      ///< metres a second squared
  float path_length = 0;            ///< metres: speed summed over time
  float displacement = 0;           ///< metres, straight from begin to end, relative to the signer
  Contact contact = Contact::none;  ///< everything touched at any frame
  PointFrame begin;                 ///< at the first frame
  PointFrame end;                   ///< at the last frame
};

/// Requires at least one frame. Gives the same values as `features_over` for a palm.
PointOver over(std::span<const PointFrame> frames, FrameRate rate, float shoulder_width) noexcept;

/// Returns tracks of points of the body over some frames (clamped to the motion), one for each part; empty if the rig
/// lacks the part, and all empty if there is no signer-centred space. Frames around the range are read for smoothing as
/// in `measure_hands`, so a part of a motion gives bit-identical results to the whole.
std::vector<PointTrack> track_points(const Motion& motion, const SignerModel& model, std::span<const Part> parts,
                                     FrameRange range);

}  // namespace signweave
