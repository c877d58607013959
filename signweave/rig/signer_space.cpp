#include "signweave/rig/signer_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr std::array<std::string_view, 8> kHeightNames = {"below_waist", "waist", "chest",    "shoulder",
                                                          "chin",        "mouth", "forehead", "above_head"};
constexpr std::array<std::string_view, 3> kAcrossNames = {"left", "centre", "right"};
constexpr std::array<std::string_view, 2> kReachNames = {"near", "far"};

// The fractions of a shoulder width by which the shoulders must be apart on the ground for their line to count, and to
// count alone.
constexpr float kNoDirection = 0.2f;
constexpr float kFullDirection = 0.5f;

/// 0 below `from`, 1 above `to`, smooth in between.
float smooth_step(float value, float from, float to) {
  const float t = std::clamp((value - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// A unit vector, or zero if there is no direction.
Vector2f direction(const Vector2f& vector) {
  const float length = vector.norm();
  return length > 1e-6f ? Vector2f(vector / length) : Vector2f::Zero();
}

}  // namespace

std::string_view name_of(Height height) noexcept {
  return kHeightNames[static_cast<std::size_t>(height)];
}
std::string_view name_of(Across across) noexcept {
  return kAcrossNames[static_cast<std::size_t>(across)];
}
std::string_view name_of(Reach reach) noexcept {
  return kReachNames[static_cast<std::size_t>(reach)];
}

std::string why_no_signer_space(const RigMap& rig) {
  for (const Side side : kSides) {
    if (!rig.has(of(side, Part::left_upper_arm))) {
      return fmt::format("no {} shoulder: name it in a mapping file", side == Side::left ? "left" : "right");
    }
  }
  return {};
}

SignerSpace signer_space(const SignerBody& body, const RigMap& rig, const ModelPose& pose) noexcept {
  const Vector3f left = position_of(rig[Part::left_upper_arm], pose);
  const Vector3f right = position_of(rig[Part::right_upper_arm], pose);
  SignerSpace space{.unit = body.shoulder_width};
  if (!left.allFinite() || !right.allFinite()) return space;
  space.origin = 0.5f * (left + right);

  // Directions on the ground as (cosine, sine) of the turn about the vertical: x to the left is (1, 0).
  const Vector2f across((left - right).x(), -(left - right).z());
  const float weight = smooth_step(across.norm() / body.shoulder_width, kNoDirection, kFullDirection);
  Vector2f turn = weight * direction(across);
  if (weight < 1 && body.trunk != kNoJoint) {
    // The turn about the vertical that is nearest to the whole rotation of the trunk, from its left and forward axes.
    const Quaternionf axes = pose.rotations[static_cast<std::size_t>(body.trunk)] * body.trunk_from_signer;
    const Vector3f x = axes * Vector3f::UnitX();
    const Vector3f z = axes * Vector3f::UnitZ();
    turn += (1 - weight) * direction({x.x() + z.z(), z.x() - x.z()});
  }
  turn = direction(turn);
  if (!turn.allFinite() || turn.isZero()) return space;
  const float half = 0.5f * std::atan2(turn.y(), turn.x());
  space.model_from_signer = Quaternionf(std::cos(half), 0, std::sin(half), 0);
  return space;
}

Zone zone_of(const Vector3f& place, const SignerBody& body) noexcept {
  Zone zone{.height = Height::below_waist};
  for (std::size_t i = 1; i < body.heights.size(); ++i) {
    if (place.y() >= body.heights[i]) zone.height = static_cast<Height>(i);
  }
  zone.across = place.x() > kCentre ? Across::left : place.x() < -kCentre ? Across::right : Across::centre;
  zone.reach = place.z() > body.near_reach ? Reach::far : Reach::near;
  return zone;
}

}  // namespace signweave
