#include "signweave/retarget/leg.h"

#include "signweave/retarget/arm.h"
#include "signweave/retarget/drives.h"

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr std::size_t at(JointIndex joint) {
  return static_cast<std::size_t>(joint);
}

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
  leg.bend_ = -(axes[thigh] * Vector3f::UnitY());
  for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
    const auto joint = static_cast<JointIndex>(i);
    if (joint != rig[thigh].joint && !path_between(skeleton, rig[thigh].joint, joint).empty()) {
      leg.below_.push_back(joint);
    }
  }
  return leg;
}

void CharacterLeg::lay(const Skeleton& skeleton, const Vector3f& goal, ModelPose& pose) const noexcept {
  const Quaternionf upper = pose.rotations[at(upper_.back())];
  const TwoBones told = {upper * upper_axis_, pose.rotations[at(lower_.front())] * lower_axis_};
  const Vector3f way = goal - pose.positions[at(upper_.front())];
  const TwoBones bones = reach(told, upper_length_, lower_length_, way, upper * bend_);
  const Quaternionf turned = turn_between(told.upper, bones.upper);
  const Quaternionf bent = turn_between(told.lower, bones.lower);
  for (const JointIndex joint : upper_) pose.rotations[at(joint)] = (turned * pose.rotations[at(joint)]).normalized();
  for (const JointIndex joint : lower_) pose.rotations[at(joint)] = (bent * pose.rotations[at(joint)]).normalized();
  for (const JointIndex joint : below_) {
    const Joint& own = skeleton.joint(joint);
    pose.positions[at(joint)] = pose.positions[at(own.parent)] + pose.rotations[at(own.parent)] * own.offset;
  }
}

}  // namespace signweave
