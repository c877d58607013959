#include "demo/handshapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "signweave/motion/turn_between.h"

namespace signweave::demo {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3f;

using Angles = std::array<float, kFingerAngles>;

// The thumb.
constexpr Angles kThumbOut = {68, 6, 0, 0};
constexpr Angles kAlongside = {22, 14, 6, 8};
constexpr Angles kHalfOpen = {38, 27, 15, 18};
constexpr Angles kAcross = {12, 42, 26, 34};  // over index and middle of a fist
constexpr Angles kLocked = {4, 36, 34, 34};   // over ring and pinky
constexpr Angles kInPalm = {20, 24, 52, 58};

// The other fingers.
constexpr Angles kStraight = {3, 3, 2, 0};
constexpr Angles kClosed = {82, 100, 62, 0};

struct Row {
  std::string_view name;
  HandAngles angles;  ///< thumb, index, middle, ring, pinky
};

// clang-format off
// In the order of the enumerators.
constexpr Row kShapes[kHandshapes] = {
    {"relaxed",    {kHalfOpen, Angles{22, 26, 14, 3}, Angles{28, 30, 16, 0}, Angles{33, 32, 17, -2}, Angles{36, 32, 18, -5}}},
    {"flat",       {kAlongside, kStraight, kStraight, kStraight, Angles{3, 3, 2, 2}}},
    {"spread",     {kThumbOut, Angles{2, 4, 3, 13}, Angles{2, 4, 3, 2}, Angles{2, 4, 3, -9}, Angles{3, 5, 3, -20}}},
    {"claw",       {Angles{52, 34, 24, 34}, Angles{18, 58, 34, 11}, Angles{20, 60, 36, 2}, Angles{20, 60, 36, -7}, Angles{18, 56, 34, -16}}},
    {"fist",       {kAcross, kClosed, kClosed, kClosed, kClosed}},
    {"thumb",      {kThumbOut, kClosed, kClosed, kClosed, kClosed}},
    {"index",      {kAcross, kStraight, kClosed, kClosed, kClosed}},
    {"hook",       {kAcross, Angles{14, 74, 48, 0}, kClosed, kClosed, kClosed}},
    {"two",        {kLocked, Angles{2, 3, 2, 11}, Angles{2, 3, 2, -9}, kClosed, kClosed}},
    {"two_flat",   {kLocked, kStraight, kStraight, kClosed, kClosed}},
    {"two_hook",   {kLocked, Angles{16, 70, 44, 9}, Angles{16, 70, 44, -7}, kClosed, kClosed}},
    {"two_out",    {kThumbOut, kStraight, kStraight, kClosed, kClosed}},
    {"three",      {kThumbOut, Angles{2, 3, 2, 11}, Angles{2, 3, 2, -7}, kClosed, kClosed}},
    {"trident",    {kLocked, Angles{2, 3, 2, 14}, Angles{2, 3, 2, 0}, Angles{2, 3, 2, -14}, kClosed}},
    {"four",       {kInPalm, Angles{2, 3, 2, 13}, Angles{2, 3, 2, 3}, Angles{2, 3, 2, -8}, Angles{2, 4, 3, -18}}},
    {"corner",     {kThumbOut, Angles{2, 3, 2, 4}, kClosed, kClosed, kClosed}},
    {"corner_low", {Angles{58, 24, 4, 4}, Angles{64, 8, 5, 2}, kClosed, kClosed, kClosed}},
    {"horns",      {kThumbOut, kClosed, kClosed, kClosed, Angles{3, 4, 3, -16}}},
    {"bull",       {kLocked, Angles{2, 3, 2, 8}, kClosed, kClosed, Angles{3, 4, 3, -14}}},
    {"wings",      {kThumbOut, Angles{2, 3, 2, 9}, kClosed, kClosed, Angles{3, 4, 3, -16}}},
    {"pinky",      {kAcross, kClosed, kClosed, kClosed, Angles{3, 4, 3, -10}}},
    {"middle_out", {kThumbOut, Angles{2, 4, 3, 12}, Angles{62, 10, 6, 0}, Angles{4, 5, 3, -9}, Angles{3, 5, 3, -19}}},
    {"ring",       {Angles{28, 53, 7, 12}, Angles{58, 52, 20, 0}, Angles{10, 6, 4, -2}, Angles{4, 5, 3, -9}, Angles{2, 4, 3, -17}}},
    {"snap",       {Angles{2, 57, 8, 12}, Angles{4, 5, 3, 9}, Angles{60, 54, 24, 0}, Angles{9, 6, 4, -7}, Angles{4, 4, 3, -16}}},
    {"pinch",      {Angles{37, 46, 16, 22}, Angles{48, 62, 30, 0}, kClosed, kClosed, kClosed}},
    {"key",        {Angles{44, 28, 30, 30}, Angles{45, 80, 40, 0}, kClosed, kClosed, kClosed}},
    {"beak",       {Angles{4, 56, 2, 2}, Angles{60, 34, 16, -2}, Angles{62, 32, 16, 0}, Angles{62, 34, 16, 3}, Angles{60, 44, 20, 8}}},
    {"bill",       {Angles{29, 56, 8, 8}, Angles{62, 6, 4, 0}, Angles{62, 6, 4, 0}, Angles{62, 6, 4, 0}, Angles{62, 7, 4, 2}}},
    {"curve",      {Angles{40, 50, 8, 22}, Angles{36, 42, 24, 0}, Angles{38, 44, 24, 0}, Angles{40, 44, 24, 0}, Angles{42, 42, 24, 0}}},
    {"cup",        {Angles{18, 30, 10, 12}, Angles{36, 10, 6, 0}, Angles{38, 10, 6, 0}, Angles{40, 10, 6, 0}, Angles{42, 10, 6, 3}}},
    {"bent",       {kAlongside, Angles{72, 6, 4, 0}, Angles{72, 6, 4, 0}, Angles{72, 6, 4, 0}, Angles{72, 6, 4, 2}}},
    {"fan",        {kThumbOut, Angles{48, 8, 5, 12}, Angles{50, 8, 5, 2}, Angles{50, 8, 5, -9}, Angles{48, 8, 5, -19}}},
    {"folded",     {kAlongside, Angles{6, 98, 64, 0}, Angles{6, 100, 66, 0}, Angles{6, 100, 66, 0}, Angles{6, 98, 64, 0}}},
    {"tucked",     {kInPalm, kStraight, kStraight, kStraight, Angles{3, 3, 2, 2}}},
};
// clang-format on

constexpr float kDegree = std::numbers::pi_v<float> / 180.0f;

// Direction of the thumb's first bone in the rest pose (signer.cpp); it bends towards the palm and the little finger.
const Vector3f kThumbRest = Vector3f(0.030f, -0.010f, 0.026f).normalized();
const Vector3f kThumbHinge = kThumbRest.cross(Vector3f(0.25f, -0.45f, -0.85f)).normalized();

Quaternionf turn_degrees(float degrees, const Vector3f& axis) {
  return Quaternionf(AngleAxisf(kDegree * degrees, axis));
}

float angle_about(const Quaternionf& rotation, const Vector3f& axis) {
  const Quaternionf q = rotation.w() < 0 ? Quaternionf(-rotation.coeffs()) : rotation;
  return 2 * std::atan2(q.vec().dot(axis), q.w()) / kDegree;
}

float eased(float t, float begin, float end) {
  const float u = std::clamp((t - begin) / (end - begin), 0.0f, 1.0f);
  return u * u * u * (10 + u * (6 * u - 15));
}

}  // namespace

std::string_view name_of(Handshape shape) noexcept {
  return kShapes[static_cast<std::size_t>(shape)].name;
}

AngleLimits limits_of(int finger, int angle) noexcept {
  constexpr AngleLimits kThumb[kFingerAngles] = {{0, 75}, {-10, 60}, {-10, 60}, {-15, 80}};
  constexpr AngleLimits kFinger[kFingerAngles] = {{-20, 90}, {0, 110}, {0, 80}, {-25, 25}};
  return finger == 0 ? kThumb[angle] : kFinger[angle];
}

const HandAngles& angles_of(Handshape shape) noexcept {
  return kShapes[static_cast<std::size_t>(shape)].angles;
}

FingerRotations finger_rotations(const HandAngles& angles, Side side) {
  FingerRotations hand;
  const Angles& thumb = angles[0];
  // Left hand: x to the fingertips, −y out of the palm, z to the thumb.
  const float aside = kDegree * thumb[0];
  const float forward = kDegree * thumb[1];
  const Vector3f along(std::cos(forward) * std::cos(aside), -std::sin(forward), std::cos(forward) * std::sin(aside));
  hand[0][0] = turn_between(kThumbRest, along);
  hand[0][1] = turn_degrees(thumb[2], kThumbHinge);
  hand[0][2] = turn_degrees(thumb[3], kThumbHinge);
  const Vector3f flexion = -Vector3f::UnitZ();
  for (std::size_t finger = 1; finger < kFingers; ++finger) {
    const Angles& wanted = angles[finger];
    hand[finger][0] = turn_degrees(wanted[3], -Vector3f::UnitY()) * turn_degrees(wanted[0], flexion);
    hand[finger][1] = turn_degrees(wanted[1], flexion);
    hand[finger][2] = turn_degrees(wanted[2], flexion);
  }
  if (side == Side::right) {
    for (auto& finger : hand) {
      for (Quaternionf& joint : finger) joint = mirrored(joint);
    }
  }
  return hand;
}

HandAngles angles_in(const FingerRotations& rotations, Side side) {
  FingerRotations hand = rotations;
  if (side == Side::right) {
    for (auto& finger : hand) {
      for (Quaternionf& joint : finger) joint = mirrored(joint);
    }
  }
  HandAngles angles{};
  const Vector3f along = hand[0][0] * kThumbRest;
  angles[0] = {std::atan2(along.z(), along.x()) / kDegree, -std::asin(std::clamp(along.y(), -1.0f, 1.0f)) / kDegree,
               angle_about(hand[0][1], kThumbHinge), angle_about(hand[0][2], kThumbHinge)};
  for (std::size_t finger = 1; finger < kFingers; ++finger) {
    // Spread, then flexion: the flexion's axis stays in the palm's plane and reveals the spread.
    const Vector3f hinge = hand[finger][0] * Vector3f::UnitZ();
    const float spread = std::atan2(-hinge.x(), hinge.z());
    const Quaternionf flexion = Quaternionf(AngleAxisf(spread, Vector3f::UnitY())) * hand[finger][0];
    angles[finger] = {angle_about(flexion, -Vector3f::UnitZ()), angle_about(hand[finger][1], -Vector3f::UnitZ()),
                      angle_about(hand[finger][2], -Vector3f::UnitZ()), spread / kDegree};
  }
  return angles;
}

HandAngles blend(const HandAngles& a, const HandAngles& b, float t) {
  HandAngles result;
  // How far the hand closes: when a fist closes the thumb waits, when it opens the thumb leads.
  float closing = 0;
  for (std::size_t finger = 1; finger < kFingers; ++finger) closing += b[finger][1] - a[finger][1];
  const float thumb_wait = std::clamp(closing / 400.0f, -0.12f, 0.12f);
  constexpr float kWait[kFingers] = {0.12f, 0.0f, 0.03f, 0.07f, 0.10f};
  for (std::size_t finger = 0; finger < kFingers; ++finger) {
    const float wait = kWait[finger] + (finger == 0 ? thumb_wait : 0.0f);
    const float done = eased(t, wait, 0.76f + wait);
    for (std::size_t i = 0; i < kFingerAngles; ++i)
      result[finger][i] = a[finger][i] + done * (b[finger][i] - a[finger][i]);
  }
  return result;
}

}  // namespace signweave::demo
