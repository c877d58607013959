#include "signweave/retarget/leg.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "signweave/retarget/angles.h"
#include "signweave/retarget/arm.h"
#include "signweave/retarget/drives.h"
#include "signweave/rig/joint_at.h"

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

/// Below the first angle a bent knee does not determine its plane; above the second it does.
constexpr float kLegPlaneFrom = 12 * std::numbers::pi_v<float> / 180;
constexpr float kLegPlaneTo = 40 * std::numbers::pi_v<float> / 180;

}  // namespace

std::optional<CharacterLeg> CharacterLeg::make(const Character& character, const RigAxes& axes, Side side) {
  const RigMap& rig = character.rig;
  const Part thigh = of(side, Part::left_thigh);
  const Part shin = of(side, Part::left_shin);
  const Part foot = of(side, Part::left_foot);
  if (!rig.has(thigh) || !rig.has(shin) || !rig.has(foot)) return std::nullopt;
  const Skeleton& skeleton = *character.skeleton;
  CharacterLeg leg;
  leg.upper_ = path_between(skeleton, rig[thigh].joint, rig[shin].joint);
  leg.lower_ = path_between(skeleton, rig[shin].joint, rig[foot].joint);
  if (leg.upper_.size() < 2 || leg.lower_.size() < 2) return std::nullopt;
  leg.upper_.pop_back();
  leg.lower_.pop_back();
  const Vector3f upper = axes.place(shin) - axes.place(thigh);
  const Vector3f lower = axes.place(foot) - axes.place(shin);
  leg.upper_length_ = upper.norm();
  leg.lower_length_ = lower.norm();
  if (leg.upper_length_ < 1e-3f || leg.lower_length_ < 1e-3f) return std::nullopt;
  leg.upper_axis_ = upper.normalized();
  leg.lower_axis_ = lower.normalized();
  leg.upper_ahead_ = axes[thigh] * Vector3f::UnitY();
  leg.lower_ahead_ = axes[shin] * Vector3f::UnitY();
  leg.foot_ = rig[foot].joint;
  leg.foot_ahead_ = axes[foot] * -Vector3f::UnitZ();
  leg.pelvis_ = skeleton.joint(leg.upper_.front()).parent;
  if (leg.pelvis_ == kNoJoint) return std::nullopt;
  leg.pelvis_ahead_ = axes.trunk() * -Vector3f::UnitZ();
  for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
    const auto joint = static_cast<JointIndex>(i);
    if (joint != rig[thigh].joint && !path_between(skeleton, rig[thigh].joint, joint).empty()) {
      leg.below_.push_back(joint);
    }
  }
  return leg;
}

void CharacterLeg::solve(const Skeleton& skeleton, const Vector3f& goal, ModelPose& pose) const noexcept {
  const Quaternionf upper = pose.rotations[at(upper_.back())];
  const TwoBones source = {upper * upper_axis_, pose.rotations[at(lower_.front())] * lower_axis_};
  // The knee points in the direction of hips and toes: some sources twist thighs arbitrarily.
  const Vector3f ahead = pose.rotations[at(pelvis_)] * pelvis_ahead_ + pose.rotations[at(foot_)] * foot_ahead_;
  const Vector3f displacement = goal - pose.positions[at(upper_.front())];
  const TwoBones bones = reach(source, upper_length_, lower_length_, displacement, -ahead);
  const Vector3f level = across(ahead, bones.upper);
  const Vector3f plane = -across(bones.lower, bones.upper);
  const float bent = std::atan2(plane.norm(), bones.upper.dot(bones.lower));
  const float weight = std::clamp((bent - kLegPlaneFrom) / (kLegPlaneTo - kLegPlaneFrom), 0.0f, 1.0f);
  Vector3f side = (1 - weight) * level.normalized();
  if (plane.norm() > 1e-4f) side += weight * plane.normalized();
  const Quaternionf thigh = axes_along(bones.upper, side) * axes_along(upper_axis_, upper_ahead_).conjugate();
  const Vector3f carried = turn_between(bones.upper, bones.lower) * across(side, bones.upper);
  const Quaternionf shin = axes_along(bones.lower, carried) * axes_along(lower_axis_, lower_ahead_).conjugate();
  for (const JointIndex joint : upper_) pose.rotations[at(joint)] = thigh;
  for (const JointIndex joint : lower_) pose.rotations[at(joint)] = shin;
  for (const JointIndex joint : below_) {
    const Joint& own = skeleton.joint(joint);
    pose.positions[at(joint)] = pose.positions[at(own.parent)] + pose.rotations[at(own.parent)] * own.offset;
  }
}

}  // namespace signweave
