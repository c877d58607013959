#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string_view>

#include "demo/signer.h"

namespace signweave::demo {

/// Hand configurations, named for their appearance. They are placeholders for those of LSF and identical to none of
/// them.
enum class Handshape {
  relaxed,     ///< at rest, half open
  flat,        ///< fingers straight and together, thumb next to them
  spread,      ///< all five apart
  claw,        ///< all five apart and hooked
  fist,        ///< closed, thumb across
  thumb,       ///< closed, thumb out
  index,       ///< index straight, the others closed
  hook,        ///< as `index`, bent
  two,         ///< index and middle apart
  two_flat,    ///< index and middle together
  two_hook,    ///< as `two`, bent
  two_out,     ///< index and middle together, thumb out
  three,       ///< thumb, index, middle
  trident,     ///< index, middle, ring apart
  four,        ///< four fingers apart, thumb in the palm
  corner,      ///< thumb and index at a right angle
  corner_low,  ///< the same, index bent at the knuckle
  horns,       ///< thumb and pinky
  bull,        ///< index and pinky
  wings,       ///< thumb, index and pinky
  pinky,       ///< pinky alone
  middle_out,  ///< all apart, the middle finger bent at the knuckle
  ring,        ///< thumb touches index, the others straight and apart
  snap,        ///< thumb touches middle, the others straight
  pinch,       ///< thumb touches index, the others closed
  key,         ///< thumb on the side of the bent index, the others closed
  beak,        ///< all fingertips touch the thumb's
  bill,        ///< straight fingers over the thumb, slightly apart
  curve,       ///< as around a glass
  cup,         ///< fingers together and slightly bent, as if holding water
  bent,        ///< flat, bent at the knuckles
  fan,         ///< bent at the knuckles, fingers apart
  folded,      ///< knuckles straight, the other joints closed
  tucked,      ///< flat, thumb across the palm
};
inline constexpr int kHandshapes = 34;

/// The enumerator's own name, such as "two_flat".
std::string_view name_of(Handshape shape) noexcept;

inline constexpr int kFingerAngles = 4;
/// Degrees, [finger][angle], thumb first. A finger: flexion of the knuckle (MCP), of the middle joint (PIP), of the end
/// joint (DIP), and spread towards the thumb. The thumb: away from the index in the palm's plane and out of that plane
/// (its first bone), flexion of its knuckle and of its end joint.
using HandAngles = std::array<std::array<float, kFingerAngles>, kFingers>;

struct AngleLimits {
  float least, most;  ///< degrees
};
/// Approximate range of a human hand without help from the other hand. A knuckle moves from 20° backwards to 90°, a
/// middle joint to 110°, an end joint to 80°; fingers spread by 25° to either side. The thumb's first bone lies between
/// the index and a right angle to it and reaches out of the palm by 60°; its knuckle bends to 60°, its end joint from
/// 15° backwards to 80°.
AngleLimits limits_of(int finger, int angle) noexcept;

/// A handshape's angles, within the limits.
const HandAngles& angles_of(Handshape shape) noexcept;

/// The local rotations of one hand's finger joints.
using FingerRotations = std::array<std::array<Eigen::Quaternionf, kPhalanges>, kFingers>;
/// The rotations for some angles on one side.
FingerRotations finger_rotations(const HandAngles& angles, Side side);
/// The angles of rotations made by `finger_rotations`; those of the thumb's first bone as directions.
HandAngles angles_in(const FingerRotations& rotations, Side side);

/// Interpolates from a to b with a timing per finger: `t` is 0 to 1 for the hand; index and middle lead, the thumb
/// leaves a closed hand first and closes last.
HandAngles blend(const HandAngles& a, const HandAngles& b, float t);

/// A rotation mirrored at x → −x: converts a rotation of the left side to the right.
inline Eigen::Quaternionf mirrored(const Eigen::Quaternionf& rotation) {
  return {rotation.w(), rotation.x(), -rotation.y(), -rotation.z()};
}

}  // namespace signweave::demo
