#include "signweave/retarget/rig_axes.h"

#include "signweave/motion/degree.h"
#include "signweave/retarget/angles.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

/// A trunk that is nearly upright at rest is assumed to be upright: its joints lie in front of and behind its centre
/// line.
constexpr float kUpright = 15 * kDegree;
/// An elbow bent by more than this at rest determines the plane in which it bends.
constexpr float kBent = 12 * kDegree;
/// A clavicle that deviates from sideways by more than this uses a space of its own.
constexpr float kSideways = 60 * kDegree;

Vector3f across_main(const Vector3f& vector, const Vector3f& main) {
  const Vector3f axis = main.normalized();
  return vector - vector.dot(axis) * axis;
}

/// Returns the nearest coordinate axis if it is close, else the direction itself.
Vector3f snapped(const Vector3f& direction) {
  Eigen::Index most = 0;
  direction.cwiseAbs().maxCoeff(&most);
  const Vector3f axis = std::copysign(1.0f, direction[most]) * Vector3f::Unit(most);
  return angle(axis, direction) < kUpright ? axis : direction.normalized();
}

}  // namespace

Quaternionf axes_along(const Vector3f& main, const Vector3f& side) noexcept {
  const Vector3f x = main.squaredNorm() > 1e-12f ? Vector3f(main.normalized()) : Vector3f(Vector3f::UnitX());
  Vector3f y = across_main(side, x);
  if (!(y.squaredNorm() > 1e-10f)) y = x.unitOrthogonal();
  y.normalize();
  Eigen::Matrix3f columns;
  columns << x, y, x.cross(y);
  return Quaternionf(columns).normalized();
}

RigAxes::RigAxes(const Skeleton& skeleton, const RigMap& rig)
    : rig_(&rig), rest_(to_model_space(skeleton, Pose(skeleton).view())) {
  axes_.fill(Quaternionf::Identity());
  take_trunk();
  for (const Side side : kSides) {
    take_leg(side);
    take_arm(side);
  }
}

void RigAxes::take_trunk() {
  const RigMap& rig = *rig_;
  const auto middle = [&](Part left, Part other) -> std::optional<Vector3f> {
    const Part right = of(Side::right, left);
    if (rig.has(left) && rig.has(right)) return Vector3f(0.5f * (place(left) + place(right)));
    return rig.has(other) ? std::optional<Vector3f>(place(other)) : std::nullopt;
  };
  Vector3f left = Vector3f::Zero();
  for (const Part part : {Part::left_upper_arm, Part::left_thigh, Part::left_clavicle}) {
    if (!rig.has(part) || !rig.has(of(Side::right, part)) || left.norm() > 0.02f) continue;
    left = place(part) - place(of(Side::right, part));
  }
  const std::optional<Vector3f> low = middle(Part::left_thigh, Part::pelvis);
  std::optional<Vector3f> high;
  for (const Part part : {Part::neck, Part::head, Part::chest}) {
    if (rig.has(part) && !high) high = place(part);
  }
  Vector3f up = low && high ? Vector3f(*high - *low) : Vector3f::Zero();
  if (up.norm() < 1e-4f) up = Vector3f::UnitY();
  if (left.norm() < 1e-4f) left = Vector3f::UnitX();
  up = snapped(up);
  trunk_ = axes_along(up, snapped(left));
  for (const Part part : {Part::pelvis, Part::spine, Part::chest, Part::neck, Part::head, Part::jaw, Part::left_eye,
                          Part::right_eye, Part::left_clavicle, Part::right_clavicle, Part::left_foot, Part::right_foot,
                          Part::left_toes, Part::right_toes}) {
    at(part) = trunk_;
  }
}

void RigAxes::take_leg(Side side) {
  const RigMap& rig = *rig_;
  const Part thigh = of(side, Part::left_thigh);
  const Part shin = of(side, Part::left_shin);
  const Part foot = of(side, Part::left_foot);
  const Part toes = of(side, Part::left_toes);
  if (!rig.has(thigh) || !rig.has(shin) || !rig.has(foot)) return;
  const Vector3f up = trunk_ * Vector3f::UnitX();
  const Vector3f upper = place(shin) - place(thigh);
  const Vector3f lower = place(foot) - place(shin);
  // Knees bend so that the shin moves back, and toes are in front: they also determine the direction if a leg has a
  // space of its own.
  Vector3f forward = trunk_ * -Vector3f::UnitZ();
  if (rig.has(toes) && across_main(place(toes) - place(foot), lower).norm() > 0.02f) {
    forward = across_main(place(toes) - place(foot), up);
    at(foot) = axes_along(up, up.cross(forward));
    at(toes) = at(foot);
  }
  at(thigh) = axes_along(upper, forward);
  at(shin) = axes_along(lower, turn_between(upper, lower) * across_main(forward, upper));
}

void RigAxes::take_arm(Side side) {
  const RigMap& rig = *rig_;
  const Part shoulder = of(side, Part::left_upper_arm);
  const Part elbow = of(side, Part::left_forearm);
  const Part wrist = of(side, Part::left_hand);
  if (!rig.has(shoulder) || !rig.has(elbow) || !rig.has(wrist)) return;
  const Vector3f upper = place(elbow) - place(shoulder);
  const Vector3f lower = place(wrist) - place(elbow);

  // The hand's own axes: to the middle knuckle, and from the little finger's side to the thumb's.
  const auto knuckle = [&](Finger finger) { return finger_part(side, finger, FingerPoint::proximal); };
  std::optional<Vector3f> first;
  std::optional<Vector3f> last;
  Vector3f sum = Vector3f::Zero();
  float count = 0;
  for (const Finger finger : {Finger::index, Finger::middle, Finger::ring, Finger::little}) {
    if (!rig.has(knuckle(finger))) continue;
    last = place(knuckle(finger));
    if (!first) first = last;
    sum += *last;
    ++count;
  }
  Vector3f along = lower;
  Vector3f thumb_side = Vector3f::Zero();
  if (count > 0) {
    along = (rig.has(knuckle(Finger::middle)) ? place(knuckle(Finger::middle)) : Vector3f(sum / count)) - place(wrist);
    if (count > 1) thumb_side = across_main(*first - *last, along);
    if (count < 2 && rig.has(knuckle(Finger::thumb)))
      thumb_side = across_main(place(knuckle(Finger::thumb)) - *first, along);
  }

  // With a straight arm whose palm faces down or the thigh, the elbow bends to the thumb's side.
  Vector3f bend = across_main(lower, upper);
  if (angle(upper, lower) < kBent)
    bend = thumb_side.norm() > 1e-4f ? thumb_side : Vector3f(trunk_ * -Vector3f::UnitZ());
  bend = across_main(bend, upper);
  if (bend.norm() < 1e-3f) bend = across_main(trunk_ * Vector3f::UnitX(), upper);
  bend.normalize();
  const Vector3f carried = turn_between(upper, lower) * bend;
  if (thumb_side.norm() < 1e-4f) thumb_side = across_main(carried, along);
  at(shoulder) = axes_along(upper, bend);
  at(elbow) = axes_along(lower, carried);
  at(wrist) = axes_along(along, thumb_side);

  const Part collar = of(side, Part::left_clavicle);
  if (rig.has(collar)) {
    const Vector3f bone = place(shoulder) - place(collar);
    const Vector3f out = (side == Side::left ? 1.0f : -1.0f) * (trunk_ * Vector3f::UnitY());
    lateral_[static_cast<std::size_t>(side)] = angle(bone, out) < kSideways;
    // With the arm stretched out and the elbow bending forward, this is up.
    const Vector3f up = side == Side::left ? bend.cross(upper) : upper.cross(bend);
    at(collar) =
        lateral_[static_cast<std::size_t>(side)] ? axes_along(bone, trunk_ * Vector3f::UnitX()) : axes_along(bone, up);
  }
  const Vector3f palm = side == Side::left ? along.cross(thumb_side) : thumb_side.cross(along);
  take_fingers(side, palm.normalized(), thumb_side.normalized());
}

void RigAxes::take_fingers(Side side, const Vector3f& palm, const Vector3f& thumb_side) {
  for (const Finger finger : kFingers) {
    // A thumb flexes in a direction halfway between across the palm and that of the fingers.
    const Vector3f aside = finger == Finger::thumb ? Vector3f((thumb_side - palm).normalized()) : thumb_side;
    Vector3f bone = (*rig_).has(of(side, Part::left_hand))
                        ? Vector3f((*this)[of(side, Part::left_hand)] * Vector3f::UnitX())
                        : Vector3f(Vector3f::UnitX());
    for (std::size_t i = 0; i < kFingerPoints; ++i) {
      const Part part = finger_part(side, finger, static_cast<FingerPoint>(i));
      if (!rig_->has(part)) continue;
      for (std::size_t k = i + 1; k < kFingerPoints; ++k) {
        const Part next = finger_part(side, finger, static_cast<FingerPoint>(k));
        if (!rig_->has(next) || (place(next) - place(part)).norm() < 1e-5f) continue;
        bone = place(next) - place(part);
        break;
      }
      at(part) = axes_along(bone, aside);
    }
  }
}

float leg_length(const RigAxes& axes, const RigMap& rig) {
  if (!rig.has(Part::left_thigh) || !rig.has(Part::left_shin) || !rig.has(Part::left_foot)) return 0;
  return (axes.place(Part::left_shin) - axes.place(Part::left_thigh)).norm() +
         (axes.place(Part::left_foot) - axes.place(Part::left_shin)).norm();
}

}  // namespace signweave
