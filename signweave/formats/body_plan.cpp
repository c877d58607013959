#include "signweave/formats/body_plan.h"

#include <algorithm>
#include <cmath>

#include "signweave/core/text.h"
#include "signweave/motion/kinematics.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

std::size_t at(JointIndex joint) {
  return static_cast<std::size_t>(joint);
}

/// Lengths below each joint, and what grows where.
struct Branches {
  const Skeleton& skeleton;
  const BodyPlan& plan;
  std::vector<float> reach;       ///< [joint] the longest way down from it, metres
  std::vector<int> bones;         ///< [joint] the same in bones, tips included
  std::vector<bool> branching;    ///< [joint] somewhere at or below it there is more than one child
  std::vector<Vector3f> longest;  ///< [joint] its longest tip, or zero

  Branches(const Skeleton& of, const BodyPlan& with)
      : skeleton(of),
        plan(with),
        reach(of.joint_count()),
        bones(of.joint_count()),
        branching(of.joint_count()),
        longest(of.joint_count(), Vector3f::Zero()) {
    for (const Tip& tip : skeleton.tips()) {
      Vector3f& known = longest[at(tip.joint)];
      if (tip.offset.norm() > known.norm()) known = tip.offset;
      reach[at(tip.joint)] = known.norm();
      bones[at(tip.joint)] = 1;
    }
    for (std::size_t joint = skeleton.joint_count(); joint-- > 1;) {
      const std::size_t parent = at(skeleton.joint(static_cast<JointIndex>(joint)).parent);
      reach[parent] = std::max(reach[parent], branch(static_cast<JointIndex>(joint)));
      bones[parent] = std::max(bones[parent], bones[joint] + 1);
      if (branching[joint] || plan.children[parent].size() > 1) branching[parent] = true;
    }
  }
  /// The length of the branch that begins with the bone to `joint`.
  float branch(JointIndex joint) const { return plan.offsets[at(joint)].norm() + reach[at(joint)]; }
};

/// `of` without its part along `axis`, at unit length; `otherwise` where nothing is left.
Vector3f across(const Vector3f& of, const Vector3f& axis, const Vector3f& otherwise) {
  const Vector3f rest = of - of.dot(axis) * axis;
  if (rest.norm() > 1e-6f) return rest.normalized();
  const Vector3f other = otherwise - otherwise.dot(axis) * axis;
  return other.norm() > 1e-6f ? Vector3f(other.normalized()) : Vector3f(axis.unitOrthogonal());
}

/// The highest joint from which three long branches grow: two arms and a neck.
JointIndex chest_of(const Motion& motion, const BodyPlan& plan, const Branches& branches) {
  const ModelPose posed = to_model_space(motion.skeleton(), motion.pose(0));
  JointIndex chest = kNoJoint;
  for (JointIndex joint = 1; at(joint) < plan.children.size(); ++joint) {
    const auto& children = plan.children[at(joint)];
    const auto big = std::count_if(children.begin(), children.end(),
                                   [&](JointIndex child) { return branches.branch(child) > 0.12f * plan.size; });
    if (big < 3) continue;
    if (chest == kNoJoint || posed.positions[at(joint)].y() > posed.positions[at(chest)].y()) chest = joint;
  }
  return chest;
}

/// Where an arm leaves the trunk: past the collar bones, which are short.
JointIndex shoulder_of(const BodyPlan& plan, const Branches& branches, JointIndex joint) {
  while (plan.children[at(joint)].size() == 1) {
    const JointIndex next = plan.children[at(joint)][0];
    if (plan.offsets[at(next)].norm() > 0.3f * branches.reach[at(joint)]) break;
    joint = next;
  }
  return joint;
}

/// Along the neck to the joint that holds the skull: the first with an end or a fork.
JointIndex head_from(const BodyPlan& plan, const Branches& branches) {
  JointIndex joint = plan.neck;
  while (plan.children[at(joint)].size() == 1 && branches.longest[at(joint)].isZero()) {
    const JointIndex next = plan.children[at(joint)][0];
    const bool end = plan.children[at(next)].empty() && branches.longest[at(next)].isZero();
    if (end && joint != plan.neck) break;  // the skull's own end, as a joint
    joint = next;
  }
  return joint;
}

std::optional<JointIndex> called_head(const Skeleton& skeleton) {
  for (std::size_t joint = 0; joint < skeleton.joint_count(); ++joint) {
    const std::string& name = skeleton.joint(static_cast<JointIndex>(joint)).name;
    const std::size_t colon = name.rfind(':');  // "mixamorig:Head"
    if (fold_case(colon == std::string::npos ? name : name.substr(colon + 1)) == "head") {
      return static_cast<JointIndex>(joint);
    }
  }
  return std::nullopt;
}

HeadShape head_shape(const BodyPlan& plan, const Branches& branches, JointIndex joint) {
  HeadShape head{.joint = joint};
  Vector3f top = branches.longest[at(joint)];
  for (const JointIndex child : plan.children[at(joint)]) {  // an end that is a joint of its own
    const Vector3f& offset = plan.offsets[at(child)];
    if (plan.children[at(child)].empty() && offset.norm() > std::max(top.norm(), 0.08f * plan.size)) top = offset;
  }
  const float length = std::clamp(top.norm(), 0.07f * plan.size, 0.15f * plan.size);
  head.up = top.norm() > 1e-6f ? Vector3f(top.normalized()) : plan.up;
  Vector3f front = Vector3f::Zero();  // eyes and jaw are in front
  for (const JointIndex child : plan.children[at(joint)]) {
    const Vector3f offset = plan.offsets[at(child)];
    front += offset - offset.dot(head.up) * head.up;
  }
  head.forward = across(front.norm() > 0.01f * plan.size ? front : plan.forward, head.up, plan.forward);
  head.left = head.up.cross(head.forward);
  head.half = Vector3f(0.42f, 0.6f, 0.5f) * length;
  head.centre = 0.5f * length * head.up;
  return head;
}

/// Every joint from which four or more unbranched, short chains grow.
std::vector<HandShape> hands_of(const BodyPlan& plan, const Branches& branches) {
  std::vector<HandShape> hands;
  for (JointIndex joint = 0; at(joint) < plan.children.size(); ++joint) {
    HandShape hand{.joint = joint, .knuckles = {}};
    for (const JointIndex child : plan.children[at(joint)]) {
      if (branches.branching[at(child)] || branches.bones[at(child)] < 2) continue;
      if (branches.branch(child) > 0.16f * plan.size) continue;
      // Four bones beyond the child: the first lies inside the palm.
      hand.knuckles.push_back(branches.bones[at(child)] > 3 ? plan.children[at(child)][0] : child);
    }
    if (hand.knuckles.size() >= 4) hands.push_back(std::move(hand));
  }
  return hands;
}

/// The way of a leg's last bone: where the toes point.
Vector3f toes(const BodyPlan& plan, const Branches& branches, JointIndex joint) {
  while (!plan.children[at(joint)].empty()) {
    const auto& children = plan.children[at(joint)];
    joint = *std::max_element(children.begin(), children.end(),
                              [&](JointIndex a, JointIndex b) { return branches.branch(a) < branches.branch(b); });
  }
  const Vector3f& tip = branches.longest[at(joint)];
  return tip.isZero() ? plan.offsets[at(joint)] : tip;
}

/// Trunk, neck, widths and directions of a body whose chest was found.
void find_trunk(const Skeleton& skeleton, const Branches& branches, JointIndex chest, BodyPlan& plan) {
  std::vector<JointIndex> grown = plan.children[at(chest)];
  std::sort(grown.begin(), grown.end(),
            [&](JointIndex a, JointIndex b) { return branches.branch(a) > branches.branch(b); });
  plan.neck = grown[2];
  for (JointIndex joint = chest; joint != kNoJoint; joint = skeleton.joint(joint).parent) {
    plan.trunk.insert(plan.trunk.begin(), joint);
  }
  // The hips are where the legs grow; what is above them in the tree is no part of the body.
  std::vector<JointIndex> legs;
  for (std::size_t i = 0; legs.empty() && i + 1 < plan.trunk.size(); ++i) {
    for (const JointIndex child : plan.children[at(plan.trunk[i])]) {
      if (child != plan.trunk[i + 1] && branches.branch(child) > 0.2f * plan.size) legs.push_back(child);
    }
    if (!legs.empty()) plan.trunk.erase(plan.trunk.begin(), plan.trunk.begin() + static_cast<std::ptrdiff_t>(i));
  }
  const Vector3f arms[] = {plan.positions[at(shoulder_of(plan, branches, grown[0]))],
                           plan.positions[at(shoulder_of(plan, branches, grown[1]))]};
  const Vector3f neck = plan.positions[at(plan.neck)] - plan.positions[at(plan.trunk[0])];
  plan.up = neck.norm() > 1e-6f ? Vector3f(neck.normalized()) : Vector3f::UnitY();
  plan.left = across(arms[0] - arms[1], plan.up, Vector3f::UnitX());
  plan.forward = plan.left.cross(plan.up);
  plan.shoulder_width = 0.5f * (arms[0] - arms[1]).norm();
  plan.hip_width = 0.5f * plan.shoulder_width;
  if (legs.size() == 2) {
    plan.hip_width = 0.5f * (plan.positions[at(legs[0])] - plan.positions[at(legs[1])]).norm();
  }
  // Which arm is the left one follows from where the toes point; without toes the body looks along z.
  float front = 0;
  for (const JointIndex leg : legs) front += toes(plan, branches, leg).dot(plan.forward);
  if (std::abs(front) < 0.02f * plan.size) front = plan.forward.z();
  if (front < 0) {
    plan.forward *= -1;
    plan.left *= -1;
  }
}

}  // namespace

BodyPlan plan_of(const Motion& motion, std::optional<JointIndex> head) {
  const Skeleton& skeleton = motion.skeleton();
  BodyPlan plan;
  plan.children.resize(skeleton.joint_count());
  Vector3f low = Vector3f::Zero();
  Vector3f high = Vector3f::Zero();
  const auto reach_to = [&](const Vector3f& place) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  };
  for (JointIndex joint = 0; at(joint) < skeleton.joint_count(); ++joint) {
    const Joint& one = skeleton.joint(joint);
    const auto moved = skeleton.translation_of(joint);
    plan.offsets.push_back(moved ? motion.pose(0).translations[*moved] : one.offset);
    if (one.parent == kNoJoint) {
      plan.positions.push_back(plan.offsets.back());
      low = high = plan.positions.back();
    } else {
      plan.positions.push_back(plan.positions[at(one.parent)] + plan.offsets.back());
      plan.children[at(one.parent)].push_back(joint);
    }
    reach_to(plan.positions.back());
  }
  for (const Tip& tip : skeleton.tips()) reach_to(plan.positions[at(tip.joint)] + tip.offset);
  plan.size = std::max((high - low).maxCoeff(), 1e-3f);

  const Branches branches(skeleton, plan);
  plan.hands = hands_of(plan, branches);
  const JointIndex chest = chest_of(motion, plan, branches);
  std::optional<JointIndex> skull = head ? head : called_head(skeleton);
  if (chest != kNoJoint) {
    find_trunk(skeleton, branches, chest, plan);
    if (!skull) skull = head_from(plan, branches);
  }
  if (skull) plan.head = head_shape(plan, branches, *skull);
  return plan;
}

}  // namespace signweave
