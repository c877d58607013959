#pragma once

#include <Eigen/Geometry>
#include <array>

#include "demo/signer.h"

namespace signweave::demo {

/// Hand configurations, named for what the hand looks like. They stand in for those of LSF and are none of them.
enum class Handshape {
  relaxed,   ///< at rest, half open
  flat,      ///< fingers straight and together, thumb beside them
  spread,    ///< all five apart
  claw,      ///< all five apart and hooked
  fist,      ///< closed, thumb across
  thumb,     ///< closed, thumb out
  index,     ///< index straight, the others closed
  hook,      ///< as `index`, bent
  two,       ///< index and middle apart
  two_flat,  ///< index and middle together
  three,     ///< thumb, index, middle
  corner,    ///< thumb and index at a right angle
  horns,     ///< thumb and pinky
  ring,      ///< thumb touches index, the others straight
  curve,     ///< as around a glass
  beak,      ///< all tips at the thumb's
  bent,      ///< flat, bent at the knuckles
};
inline constexpr int kHandshapes = 17;

/// The local rotations of one hand's finger joints.
using FingerRotations = std::array<std::array<Eigen::Quaternionf, kPhalanges>, kFingers>;

/// A handshape on one side. `bend` adds that many radians to the first joint of each finger, the thumb's halved: for
/// flutter and for the small unrest that a living hand has.
FingerRotations finger_rotations(Handshape shape, Side side, const std::array<float, kFingers>& bend = {});

/// Each joint by slerp from a to b.
FingerRotations blend(const FingerRotations& a, const FingerRotations& b, float t);

/// A rotation seen in the mirror x → −x: what the left side does, done by the right.
inline Eigen::Quaternionf mirrored(const Eigen::Quaternionf& rotation) {
  return {rotation.w(), rotation.x(), -rotation.y(), -rotation.z()};
}

}  // namespace signweave::demo
