#include "signweave/transition/wrist_guard.h"

#include <algorithm>
#include <cmath>

#include "signweave/transition/knots.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// True if a bend stays within the limits even if it increases by `farther` radians.
bool within(const WristBend& bend, float farther, const WristLimits& limits) {
  return bend.flexion + farther < limits.flexion.freely && -bend.flexion + farther < limits.extension.freely &&
         bend.deviation + farther < limits.radial.freely && -bend.deviation + farther < limits.ulnar.freely;
}

}  // namespace

void WristGuard::begin(BodyScene& scene, Side side) {
  side_ = side;
  limits_.reset();
  if (!scene.has_fingers(side)) return;
  wrist_ = scene.joints(side).wrist;
  const std::array<std::int64_t, 2> borders{-1, scene.count()};
  std::array<HandAxes, 2> axes;
  for (std::size_t i = 0; i < 2; ++i) axes[i] = axes_of(scene.hand(side, borders[i]), side);
  // If the bones of the palm move, the hand's axes are the mean of both borders.
  axes_.fingers = (axes[0].fingers + axes[1].fingers).normalized();
  const Vector3f palm = axes[0].palm + axes[1].palm;
  axes_.palm = (palm - palm.dot(axes_.fingers) * axes_.fingers).normalized();
  axes_.thumb = side == Side::left ? axes_.palm.cross(axes_.fingers) : axes_.fingers.cross(axes_.palm);
  limits_ = human_wrist();
  for (const std::int64_t border : borders) limits_ = widened(*limits_, bend_at(scene, border));
}

WristBend WristGuard::bend_at(const BodyScene& scene, std::int64_t frame) const {
  const Vector3f forearm = scene.forearm(side_, frame);
  const float length = forearm.norm();
  return length > 1e-4f ? wrist_bend(forearm / length, axes_) : WristBend{};
}

bool WristGuard::limit(const BodyScene& scene, std::int64_t frame) const {
  if (!limits_) return false;
  const Vector3f forearm = scene.forearm(side_, frame);
  const float length = forearm.norm();
  Eigen::Quaternionf turn;
  if (!(length > 1e-4f) || !turn_within(*limits_, forearm / length, axes_, turn)) return false;
  Eigen::Quaternionf& local = scene.made(frame).rotations[static_cast<std::size_t>(wrist_)];
  set_in_hemisphere(local, local * turn);
  return true;
}

bool WristGuard::limit_all(const BodyScene& scene, const Gap& gap) const {
  if (!limits_) return false;
  const std::int64_t stride = knot_stride(gap.rate);
  bool limited = false;
  WristBend before = bend_at(scene, -1);
  for (std::int64_t begin = -1; begin < gap.count;) {
    const std::int64_t end = std::min(begin + stride, gap.count);
    const WristBend after = bend_at(scene, end);
    const float turned = std::hypot(after.flexion - before.flexion, after.deviation - before.deviation);
    // A border may be at its limit without anything next to it exceeding it, if the wrist hardly moves.
    const bool far = within(before, turned, *limits_) && within(after, turned, *limits_);
    for (std::int64_t frame = begin + 1; frame <= std::min(end, gap.count - 1); ++frame) {
      if (!far) limited |= limit(scene, frame);
    }
    before = after;
    begin = end;
  }
  return limited;
}

}  // namespace signweave
