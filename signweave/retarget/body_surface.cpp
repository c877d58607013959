#include "signweave/retarget/body_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace signweave {
namespace {

using Eigen::Matrix3f;
using Eigen::Quaternionf;
using Eigen::Vector3f;

/// The height of the person described by the tables, metres.
constexpr float kHeight = 1.67f;

/// A cross-section of the trunk: metres for that person, relative to the midpoint of the shoulders.
struct Section {
  float up;
  float middle;  ///< forward
  float depth;   ///< half the depth
  float width;   ///< half the width
};
/// Measured on a woman and a man, who differ by less than 8 mm once scaled by height. Both ends taper to points, so
/// that the displacement is continuous there.
constexpr std::array<Section, 13> kTrunk = {{{0.17f, -0.030f, 0.001f, 0.001f},
                                             {0.12f, -0.025f, 0.045f, 0.060f},
                                             {0.05f, 0.000f, 0.068f, 0.120f},
                                             {0.00f, 0.012f, 0.088f, 0.165f},
                                             {-0.05f, 0.022f, 0.102f, 0.175f},
                                             {-0.10f, 0.028f, 0.110f, 0.170f},
                                             {-0.20f, 0.032f, 0.105f, 0.158f},
                                             {-0.35f, 0.012f, 0.116f, 0.168f},
                                             {-0.45f, -0.008f, 0.130f, 0.187f},
                                             {-0.55f, 0.012f, 0.102f, 0.190f},
                                             {-0.70f, 0.035f, 0.085f, 0.194f},
                                             {-0.85f, 0.020f, 0.070f, 0.200f},
                                             {-1.00f, 0.020f, 0.001f, 0.001f}}};
/// Above the first height the trunk follows the chest, below the second the pelvis, blended in between.
constexpr float kChest = -0.15f;
constexpr float kPelvis = -0.45f;
/// No part of the trunk is farther from the midpoint of the shoulders, forward or to the side.
constexpr float kFar = 0.25f;
/// The distance of the head's centre behind the midpoint of the eyes; half its width, height and depth.
constexpr float kHeadBehind = 0.066f;
const Vector3f kHead = {0.078f, 0.118f, 0.095f};

/// Returns the section at a height, interpolated in the table; nullopt above and below.
std::optional<Section> section_at(float up) {
  for (std::size_t i = 0; i + 1 < kTrunk.size(); ++i) {
    const Section& a = kTrunk[i];
    const Section& b = kTrunk[i + 1];
    if (up > a.up || up < b.up) continue;
    const float share = (a.up - up) / (a.up - b.up);
    const auto mix = [&](float from, float to) { return from + share * (to - from); };
    return Section{up, mix(a.middle, b.middle), mix(a.depth, b.depth), mix(a.width, b.width)};
  }
  return std::nullopt;
}

/// Returns the displacement out of a body whose surface is |x/a|³ + |y/b|³ + |z/c|³ = 1; zero if `start` is outside. A
/// very large half size disables an axis.
Vector3f displacement_out_of(const Vector3f& start, const Vector3f& half) noexcept {
  const Vector3f share = start.cwiseQuotient(half).cwiseAbs();
  const float sum = share.cwiseProduct(share).dot(share);
  if (sum >= 1) return Vector3f::Zero();
  const float value = std::cbrt(std::max(sum, 1e-6f));
  // The gradient of the cube root, which grows linearly from the centre to 1 on the surface. The function is convex, so
  // a step computed for a flat surface ends on it or slightly outside.
  Vector3f gradient = share.cwiseProduct(share).cwiseQuotient(half) / (value * value);
  for (Eigen::Index i = 0; i < 3; ++i) gradient[i] = std::copysign(gradient[i], start[i]);
  if (gradient.squaredNorm() < 1e-6f) gradient = Vector3f(0, 0, 1 / half.z());
  return (1 - value) / gradient.squaredNorm() * gradient;
}

}  // namespace

BodySurface::BodySurface(const Character& character, const RigAxes& axes) {
  if (character.height <= 0) return;
  scale_ = character.height / kHeight;
  const RigMap& rig = character.rig;
  // Columns: left, up, forward, from the trunk's axes, whose x is up and y left.
  Matrix3f columns;
  columns << axes.trunk() * Vector3f::UnitY(), axes.trunk() * Vector3f::UnitX(), axes.trunk() * -Vector3f::UnitZ();
  const Quaternionf turn(columns);
  JointIndex chest = kNoJoint;
  JointIndex pelvis = kNoJoint;
  for (const Part part : {Part::pelvis, Part::spine, Part::chest}) {
    if (!rig.has(part)) continue;
    chest = rig[part].joint;
    if (pelvis == kNoJoint) pelvis = chest;
  }
  const auto at_rest = [&](JointIndex joint) { return axes.places()[static_cast<std::size_t>(joint)]; };
  if (chest != kNoJoint && rig.has(Part::left_upper_arm) && rig.has(Part::right_upper_arm)) {
    const Vector3f middle = 0.5f * (axes.place(Part::left_upper_arm) + axes.place(Part::right_upper_arm));
    chest_ = Space{chest, middle - at_rest(chest), turn};
    pelvis_ = Space{pelvis, middle - at_rest(pelvis), turn};
  }
  if (rig.has(Part::head) && character.eyes.squaredNorm() > 0) {
    head_ = Space{rig[Part::head].joint, character.eyes - at_rest(rig[Part::head].joint), turn};
  }
}

void BodySurface::place(const ModelPose& pose) noexcept {
  for (std::optional<Space>* space : {&chest_, &pelvis_, &head_}) {
    if (!*space) continue;
    const auto joint = static_cast<std::size_t>((*space)->joint);
    (*space)->origin_now = pose.positions[joint] + pose.rotations[joint] * (*space)->origin;
    (*space)->turn_now = pose.rotations[joint] * (*space)->turn;
  }
}

Vector3f BodySurface::push_out_of_trunk(const Vector3f& point, float radius) noexcept {
  const std::optional<Section> section = section_at(point.y());
  if (!section) return Vector3f::Zero();
  // Within the section only: points are not pushed up or down.
  const Vector3f from_middle(point.x(), 0, point.z() - section->middle);
  return displacement_out_of(from_middle, {section->width + radius, 1e6f, section->depth + radius});
}

Vector3f BodySurface::push_out_of_head(const Vector3f& point, float radius) noexcept {
  return displacement_out_of(point + Vector3f(0, 0, kHeadBehind), kHead + Vector3f::Constant(radius));
}

Vector3f BodySurface::push_out(const Vector3f& point, float radius) const noexcept {
  Vector3f displacement = Vector3f::Zero();
  const float ball = radius / scale_;
  const auto inside = [&](const Space& space) {
    return Vector3f(space.turn_now.conjugate() * (point - space.origin_now) / scale_);
  };
  if (chest_) {
    const Vector3f high = inside(*chest_);
    const Vector3f low = inside(*pelvis_);
    const float share = std::clamp((kChest - high.y()) / (kChest - kPelvis), 0.0f, 1.0f);
    const Vector3f mixed = (1 - share) * high + share * low;
    if (std::abs(mixed.x()) < kFar && std::abs(mixed.z()) < kFar) {
      const Vector3f out = push_out_of_trunk(mixed, ball);
      displacement += scale_ * ((1 - share) * (chest_->turn_now * out) + share * (pelvis_->turn_now * out));
    }
  }
  if (head_) {
    const Vector3f from_eyes = inside(*head_);
    if (from_eyes.squaredNorm() < kFar * kFar)
      displacement += scale_ * (head_->turn_now * push_out_of_head(from_eyes, ball));
  }
  return displacement;
}

}  // namespace signweave
