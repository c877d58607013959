#include "signweave/drawing/body_plan.h"

#include <algorithm>
#include <cmath>

#include "signweave/rig/body_shape.h"
#include "signweave/rig/joint_at.h"
#include "signweave/rig/structure.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// `of` without its component along `axis`, at unit length; `otherwise` if the remainder is zero.
Vector3f across(const Vector3f& of, const Vector3f& axis, const Vector3f& otherwise) {
  const Vector3f rest = of - of.dot(axis) * axis;
  if (rest.norm() > 1e-6f) return rest.normalized();
  const Vector3f other = otherwise - otherwise.dot(axis) * axis;
  return other.norm() > 1e-6f ? Vector3f(other.normalized()) : Vector3f(axis.unitOrthogonal());
}

HeadShape head_shape(const Skeleton& skeleton, const BodyPlan& plan, const BodyShape& shape, JointIndex joint) {
  HeadShape head{.joint = joint};
  // Its top is the end that is highest above the trunk: a tip, or a joint without children.
  Vector3f top = Vector3f::Zero();
  const auto consider = [&](const Vector3f& end) {
    if (end.dot(plan.up) > top.dot(plan.up)) top = end;
  };
  for (std::size_t i = 0; i < skeleton.tips().size(); ++i) {
    if (skeleton.tips()[i].joint == joint) consider(plan.tip_bones[i]);
  }
  for (const JointIndex child : plan.children[at(joint)]) {
    if (shape.below(child).empty() && !shape.has_tip(child)) consider(plan.bones[at(child)]);
  }
  const float length = std::clamp(top.norm(), 0.08f * plan.size, 0.15f * plan.size);
  head.up = top.norm() > 0.04f * plan.size ? Vector3f(top.normalized()) : plan.up;
  // A head is never tilted as far as the shoulder: the skull ends of some rigs point sideways, whatever the head does.
  if (head.up.dot(plan.up) < 0.5f) head.up = plan.up;
  Vector3f front = Vector3f::Zero();  // eyes and jaw are in front
  for (const JointIndex child : plan.children[at(joint)]) {
    const Vector3f& bone = plan.bones[at(child)];
    front += bone - bone.dot(head.up) * head.up;
  }
  head.forward = across(front.norm() > 0.01f * plan.size ? front : plan.forward, head.up, plan.forward);
  head.left = head.up.cross(head.forward);
  head.half = Vector3f(0.42f, 0.6f, 0.5f) * length;
  head.centre = plan.place(joint) + 0.5f * length * head.up;
  return head;
}

std::vector<HandShape> hands_of(const Skeleton& skeleton, const BodyShape& shape, const RigMap& rig) {
  std::vector<HandShape> hands;
  for (const Side side : kSides) {
    const PartPlace& wrist = rig[of(side, Part::left_hand)];
    if (!wrist.known()) continue;
    HandShape hand{.joint = wrist.joint, .knuckles = {}};
    for (const Finger finger : kFingers) {
      const PartPlace& knuckle = rig[finger_part(side, finger, FingerPoint::proximal)];
      if (!knuckle.known() || knuckle.joint == hand.joint) continue;
      if (grows_from(skeleton, knuckle.joint, hand.joint)) hand.knuckles.push_back(knuckle.joint);
    }
    // Fingers in an unknown order are still enough for a palm.
    if (hand.knuckles.size() < 4) hand.knuckles = knuckles_of(skeleton, shape, hand.joint);
    if (hand.knuckles.size() >= 4) hands.push_back(std::move(hand));
  }
  return hands;
}

/// The child of `from` that is `joint` or an ancestor of it.
JointIndex child_towards(const Skeleton& skeleton, JointIndex from, JointIndex joint) {
  while (skeleton.joint(joint).parent != from) joint = skeleton.joint(joint).parent;
  return joint;
}

/// Finds trunk, neck, widths and directions, if the map has all of the trunk's joints.
void find_trunk(const Skeleton& skeleton, const RigMap& rig, BodyPlan& plan) {
  const auto joint_of = [&](Part part) { return rig[part].joint; };
  const JointIndex chest = joint_of(Part::chest);
  const JointIndex pelvis = joint_of(Part::pelvis);
  const JointIndex top = rig.has(Part::neck) ? joint_of(Part::neck) : joint_of(Part::head);
  const JointIndex shoulders[] = {joint_of(Part::left_upper_arm), joint_of(Part::right_upper_arm)};
  if (chest == kNoJoint || pelvis == kNoJoint || !grows_from(skeleton, chest, pelvis)) return;
  for (const JointIndex joint : {top, shoulders[0], shoulders[1]}) {
    if (joint == kNoJoint || joint == chest || !grows_from(skeleton, joint, chest)) return;
  }
  plan.neck = child_towards(skeleton, chest, top);
  for (JointIndex joint = chest; joint != pelvis; joint = skeleton.joint(joint).parent) {
    plan.trunk.insert(plan.trunk.begin(), joint);
  }
  plan.trunk.insert(plan.trunk.begin(), pelvis);
  plan.shoulders = {shoulders[0], shoulders[1]};
  for (const JointIndex shoulder : shoulders) {
    for (JointIndex joint = skeleton.joint(shoulder).parent; joint != chest; joint = skeleton.joint(joint).parent) {
      plan.collars.push_back(joint);
    }
  }
  const Vector3f between = plan.place(shoulders[0]) - plan.place(shoulders[1]);
  const Vector3f neck = plan.place(plan.neck) - plan.place(pelvis);
  plan.up = neck.norm() > 1e-6f ? Vector3f(neck.normalized()) : Vector3f::UnitY();
  plan.left = across(between, plan.up, Vector3f::UnitX());
  plan.forward = plan.left.cross(plan.up);
  plan.shoulder_width = 0.5f * between.norm();
  plan.hip_width = 0.5f * plan.shoulder_width;
  if (rig.has(Part::left_thigh) && rig.has(Part::right_thigh)) {
    plan.hip_width = 0.5f * (plan.place(joint_of(Part::left_thigh)) - plan.place(joint_of(Part::right_thigh))).norm();
  }
}

}  // namespace

BodyPlan plan_of(const Motion& motion, const RigMap& rig) {
  const Skeleton& skeleton = motion.skeleton();
  BodyShape shape = shape_of(motion);
  BodyPlan plan{.pose = shape.pose(), .children = shape.children, .size = shape.size};
  for (JointIndex joint = 0; at(joint) < skeleton.joint_count(); ++joint) {
    const JointIndex parent = skeleton.joint(joint).parent;
    plan.bones.emplace_back(parent == kNoJoint ? Vector3f::Zero() : Vector3f(plan.place(joint) - plan.place(parent)));
  }
  for (const Tip& tip : skeleton.tips()) {
    plan.tip_bones.emplace_back(plan.pose.rotations[at(tip.joint)] * tip.offset);
  }
  plan.hands = hands_of(skeleton, shape, rig);
  find_trunk(skeleton, rig, plan);
  if (rig.has(Part::head)) plan.head = head_shape(skeleton, plan, shape, rig[Part::head].joint);
  return plan;
}

}  // namespace signweave
