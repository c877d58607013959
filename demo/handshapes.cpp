#include "demo/handshapes.h"

#include <numbers>

#include "signweave/motion/blend.h"

namespace signweave::demo {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3f;

struct Bend {
  float knuckle, middle, end;  ///< degrees of flexion
  float spread;                ///< degrees towards the thumb
};

struct ThumbPose {
  Vector3f along;  ///< where its first bone points; left hand: x to the fingertips, −y out of the palm, z to the thumb
  float middle, end;  ///< degrees of flexion
};

struct Shape {
  Bend fingers[4];  ///< index, middle, ring, pinky
  ThumbPose thumb;
};

const ThumbPose kOut = {{0.30f, -0.10f, 0.95f}, 0, 0};
const ThumbPose kBeside = {{0.90f, -0.25f, 0.36f}, 6, 8};
const ThumbPose kHalfOpen = {{0.70f, -0.45f, 0.56f}, 15, 18};
const ThumbPose kAcross = {{0.62f, -0.74f, 0.26f}, 48, 45};
const ThumbPose kOpposed = {{0.66f, -0.70f, 0.28f}, 14, 24};

constexpr Bend kStraight = {3, 3, 2, 0};
constexpr Bend kClosed = {82, 100, 62, 0};

// In the order of the enumerators.
const Shape kShapes[kHandshapes] = {
    {{{22, 26, 14, 3}, {28, 30, 16, 0}, {33, 32, 17, -2}, {36, 32, 18, -5}}, kHalfOpen},
    {{kStraight, kStraight, kStraight, {3, 3, 2, 2}}, kBeside},
    {{{2, 4, 3, 13}, {2, 4, 3, 2}, {2, 4, 3, -9}, {3, 5, 3, -20}}, kOut},
    {{{18, 58, 34, 11}, {20, 60, 36, 2}, {20, 60, 36, -7}, {18, 56, 34, -16}}, {{0.55f, -0.50f, 0.67f}, 24, 34}},
    {{kClosed, kClosed, kClosed, kClosed}, kAcross},
    {{kClosed, kClosed, kClosed, kClosed}, kOut},
    {{kStraight, kClosed, kClosed, kClosed}, kAcross},
    {{{14, 74, 48, 0}, kClosed, kClosed, kClosed}, kAcross},
    {{{2, 3, 2, 11}, {2, 3, 2, -9}, kClosed, kClosed}, kAcross},
    {{kStraight, kStraight, kClosed, kClosed}, kAcross},
    {{{2, 3, 2, 11}, {2, 3, 2, -7}, kClosed, kClosed}, kOut},
    {{{2, 3, 2, 4}, kClosed, kClosed, kClosed}, kOut},
    {{kClosed, kClosed, kClosed, {3, 4, 3, -16}}, kOut},
    {{{50, 54, 26, 0}, {10, 6, 4, -2}, {4, 5, 3, -8}, {2, 4, 3, -16}}, kOpposed},
    {{{36, 42, 24, 0}, {38, 44, 24, 0}, {40, 44, 24, 0}, {42, 42, 24, 0}}, {{0.48f, -0.78f, 0.40f}, 8, 22}},
    {{{58, 30, 14, -2}, {60, 28, 14, 0}, {61, 30, 14, 3}, {60, 36, 16, 8}}, {{0.72f, -0.66f, 0.20f}, 2, 6}},
    {{{72, 6, 4, 0}, {72, 6, 4, 0}, {72, 6, 4, 0}, {72, 6, 4, 2}}, kBeside},
};

float radians(float degrees) {
  return degrees * std::numbers::pi_v<float> / 180.0f;
}

Quaternionf turn(float angle, const Vector3f& axis) {
  return Quaternionf(AngleAxisf(angle, axis));
}

}  // namespace

FingerRotations finger_rotations(Handshape shape, Side side, const std::array<float, kFingers>& bend) {
  const Shape& wanted = kShapes[static_cast<std::size_t>(shape)];
  FingerRotations hand;
  // The thumb's first bone lies so in the rest pose (signer.cpp); it bends towards the palm and the little finger.
  const Vector3f rest = Vector3f(0.030f, -0.010f, 0.026f).normalized();
  const Vector3f hinge = rest.cross(Vector3f(0.25f, -0.45f, -0.85f)).normalized();
  hand[0][0] = Quaternionf::FromTwoVectors(rest, wanted.thumb.along.normalized()) * turn(0.5f * bend[0], hinge);
  hand[0][1] = turn(radians(wanted.thumb.middle), hinge);
  hand[0][2] = turn(radians(wanted.thumb.end), hinge);
  for (std::size_t finger = 1; finger < kFingers; ++finger) {
    const Bend& angles = wanted.fingers[finger - 1];
    const Vector3f flexion = -Vector3f::UnitZ();
    hand[finger][0] =
        turn(radians(angles.spread), -Vector3f::UnitY()) * turn(radians(angles.knuckle) + bend[finger], flexion);
    hand[finger][1] = turn(radians(angles.middle), flexion);
    hand[finger][2] = turn(radians(angles.end), flexion);
  }
  if (side == Side::right) {
    for (auto& finger : hand) {
      for (Quaternionf& joint : finger) joint = mirrored(joint);
    }
  }
  return hand;
}

FingerRotations blend(const FingerRotations& a, const FingerRotations& b, float t) {
  FingerRotations result;
  for (std::size_t finger = 0; finger < kFingers; ++finger) {
    for (std::size_t i = 0; i < kPhalanges; ++i) result[finger][i] = slerp(a[finger][i], b[finger][i], t);
  }
  return result;
}

}  // namespace signweave::demo
