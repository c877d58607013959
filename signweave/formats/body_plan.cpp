#include "signweave/formats/body_plan.h"

#include <algorithm>
#include <cmath>

#include "signweave/core/text.h"

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
    for (std::size_t i = 0; i < skeleton.tips().size(); ++i) {
      const std::size_t joint = at(skeleton.tips()[i].joint);
      if (plan.tip_bones[i].norm() > longest[joint].norm()) longest[joint] = plan.tip_bones[i];
      reach[joint] = longest[joint].norm();
      bones[joint] = 1;
    }
    for (std::size_t joint = skeleton.joint_count(); joint-- > 1;) {
      const std::size_t parent = at(skeleton.joint(static_cast<JointIndex>(joint)).parent);
      reach[parent] = std::max(reach[parent], branch(static_cast<JointIndex>(joint)));
      bones[parent] = std::max(bones[parent], bones[joint] + 1);
      if (branching[joint] || plan.children[parent].size() > 1) branching[parent] = true;
    }
  }
  /// The length of the branch that begins with the bone to `joint`.
  float branch(JointIndex joint) const { return plan.bones[at(joint)].norm() + reach[at(joint)]; }
};

/// `of` without its part along `axis`, at unit length; `otherwise` where nothing is left.
Vector3f across(const Vector3f& of, const Vector3f& axis, const Vector3f& otherwise) {
  const Vector3f rest = of - of.dot(axis) * axis;
  if (rest.norm() > 1e-6f) return rest.normalized();
  const Vector3f other = otherwise - otherwise.dot(axis) * axis;
  return other.norm() > 1e-6f ? Vector3f(other.normalized()) : Vector3f(axis.unitOrthogonal());
}

/// The highest joint from which three long branches grow: two arms and a neck.
JointIndex chest_of(const BodyPlan& plan, const Branches& branches) {
  JointIndex chest = kNoJoint;
  for (JointIndex joint = 1; at(joint) < plan.children.size(); ++joint) {
    const auto& children = plan.children[at(joint)];
    const auto big = std::count_if(children.begin(), children.end(),
                                   [&](JointIndex child) { return branches.branch(child) > 0.12f * plan.size; });
    if (big < 3) continue;
    if (chest == kNoJoint || plan.place(joint).y() > plan.place(chest).y()) chest = joint;
  }
  return chest;
}

/// Where a limb leaves the trunk: past collar or hip bones, which are short.
JointIndex limb_from(const BodyPlan& plan, const Branches& branches, JointIndex joint) {
  while (plan.children[at(joint)].size() == 1) {
    const JointIndex next = plan.children[at(joint)][0];
    if (plan.bones[at(next)].norm() > 0.3f * branches.reach[at(joint)]) break;
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

HeadShape head_shape(const Skeleton& skeleton, const BodyPlan& plan, const Branches& branches, JointIndex joint) {
  HeadShape head{.joint = joint};
  // Its top is the end that is highest above the trunk: a tip, or a joint from which nothing grows.
  Vector3f top = Vector3f::Zero();
  const auto consider = [&](const Vector3f& end) {
    if (end.dot(plan.up) > top.dot(plan.up)) top = end;
  };
  for (std::size_t i = 0; i < skeleton.tips().size(); ++i) {
    if (skeleton.tips()[i].joint == joint) consider(plan.tip_bones[i]);
  }
  for (const JointIndex child : plan.children[at(joint)]) {
    if (branches.bones[at(child)] == 0) consider(plan.bones[at(child)]);
  }
  const float length = std::clamp(top.norm(), 0.08f * plan.size, 0.15f * plan.size);
  head.up = top.norm() > 0.04f * plan.size ? Vector3f(top.normalized()) : plan.up;
  // Nobody lays the head on the shoulder: some rigs' skull ends point aside, whatever the head does.
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
  return tip.isZero() ? plan.bones[at(joint)] : tip;
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
  // Without legs, a root on the ground shows by its bone, which is longer than all the trunk.
  const auto to_neck = [&](JointIndex joint) { return (plan.place(plan.neck) - plan.place(joint)).norm(); };
  if (legs.empty() && plan.trunk.size() > 1 && plan.bones[at(plan.trunk[1])].norm() > 1.2f * to_neck(plan.trunk[1])) {
    plan.trunk.erase(plan.trunk.begin());
  }
  const JointIndex shoulders[] = {limb_from(plan, branches, grown[0]), limb_from(plan, branches, grown[1])};
  plan.shoulders = {shoulders[0], shoulders[1]};
  const Vector3f arms[] = {plan.place(shoulders[0]), plan.place(shoulders[1])};
  for (const JointIndex shoulder : shoulders) {
    for (JointIndex joint = skeleton.joint(shoulder).parent; joint != chest; joint = skeleton.joint(joint).parent) {
      plan.collars.push_back(joint);
    }
  }
  const Vector3f neck = plan.place(plan.neck) - plan.place(plan.trunk[0]);
  plan.up = neck.norm() > 1e-6f ? Vector3f(neck.normalized()) : Vector3f::UnitY();
  plan.left = across(arms[0] - arms[1], plan.up, Vector3f::UnitX());
  plan.forward = plan.left.cross(plan.up);
  plan.shoulder_width = 0.5f * (arms[0] - arms[1]).norm();
  plan.hip_width = 0.5f * plan.shoulder_width;
  if (legs.size() == 2) {
    const Vector3f between =
        plan.place(limb_from(plan, branches, legs[0])) - plan.place(limb_from(plan, branches, legs[1]));
    plan.hip_width = 0.5f * between.norm();
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

/// About the stature: the longest way through the body, from a hand to a foot, is a third longer.
float size_of(const BodyPlan& plan, const Branches& branches) {
  float longest = 0;
  for (std::size_t joint = 0; joint < plan.children.size(); ++joint) {
    float first = branches.longest[joint].norm();
    float second = 0;
    for (const JointIndex child : plan.children[joint]) {
      second = std::max(second, std::min(first, branches.branch(child)));
      first = std::max(first, branches.branch(child));
    }
    longest = std::max(longest, first + second);
  }
  return std::max(0.74f * longest, 1e-3f);
}

}  // namespace

BodyPlan plan_of(const Motion& motion, std::optional<JointIndex> head) {
  const Skeleton& skeleton = motion.skeleton();
  BodyPlan plan;
  plan.pose = to_model_space(skeleton, motion.pose(motion.frame_count() / 2));
  plan.children.resize(skeleton.joint_count());
  for (JointIndex joint = 0; at(joint) < skeleton.joint_count(); ++joint) {
    const JointIndex parent = skeleton.joint(joint).parent;
    plan.bones.emplace_back(parent == kNoJoint ? Vector3f::Zero() : Vector3f(plan.place(joint) - plan.place(parent)));
    if (parent != kNoJoint) plan.children[at(parent)].push_back(joint);
  }
  for (const Tip& tip : skeleton.tips()) {
    plan.tip_bones.emplace_back(plan.pose.rotations[at(tip.joint)] * tip.offset);
  }
  const Branches branches(skeleton, plan);
  plan.size = size_of(plan, branches);
  plan.hands = hands_of(plan, branches);
  std::optional<JointIndex> skull = head ? head : called_head(skeleton);
  if (const JointIndex chest = chest_of(plan, branches); chest != kNoJoint) {
    find_trunk(skeleton, branches, chest, plan);
    if (!skull) skull = head_from(plan, branches);
  }
  if (skull) plan.head = head_shape(skeleton, plan, branches, *skull);
  return plan;
}

}  // namespace signweave
