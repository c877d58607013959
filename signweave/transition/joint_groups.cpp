#include "signweave/transition/joint_groups.h"

namespace signweave {

std::string_view name_of(JointGroup group) noexcept {
  switch (group) {
    case JointGroup::body:
      return "body";
    case JointGroup::left_arm:
      return "left_arm";
    case JointGroup::right_arm:
      return "right_arm";
    case JointGroup::left_fingers:
      return "left_fingers";
    case JointGroup::right_fingers:
      return "right_fingers";
  }
  return "body";
}

JointGroups joint_groups(const Skeleton& skeleton, const RigMap& rig) {
  JointGroups groups;
  groups.of.assign(skeleton.joint_count(), JointGroup::body);
  groups.roles.assign(skeleton.joint_count(), JointRole::other);
  const auto role = [&](JointIndex joint) -> JointRole& { return groups.roles[static_cast<std::size_t>(joint)]; };
  const auto at = [&](JointIndex joint) -> JointGroup& { return groups.of[static_cast<std::size_t>(joint)]; };
  for (const Side side : kSides) {
    const JointIndex wrist = rig[of(side, Part::left_hand)].joint;
    if (wrist == kNoJoint) continue;
    const JointIndex clavicle = rig[of(side, Part::left_clavicle)].joint;
    const JointIndex top = clavicle != kNoJoint ? clavicle : rig[of(side, Part::left_upper_arm)].joint;
    if (top == kNoJoint) continue;
    // The chain first; then descendants of the wrist are fingers, and other descendants of the arm belong to the arm.
    bool reached = false;
    for (JointIndex joint = wrist; joint != kNoJoint && !reached; joint = skeleton.joint(joint).parent) {
      reached = joint == top;
    }
    if (!reached) continue;
    groups.wrists[static_cast<std::size_t>(side)] = wrist;
    for (JointIndex joint = skeleton.joint(top).parent; joint != kNoJoint; joint = skeleton.joint(joint).parent) {
      role(joint) = JointRole::trunk;
    }
    for (JointIndex joint = wrist; joint != skeleton.joint(top).parent; joint = skeleton.joint(joint).parent) {
      at(joint) = arm_of(side);
    }
    for (JointIndex joint = top + 1; joint < static_cast<JointIndex>(skeleton.joint_count()); ++joint) {
      const JointIndex parent = skeleton.joint(joint).parent;
      if (parent == wrist || at(parent) == fingers_of(side)) {
        at(joint) = fingers_of(side);
        role(joint) = JointRole::finger;
      } else if (at(parent) == arm_of(side)) {
        at(joint) = arm_of(side);
      }
    }
  }
  for (const Side side : kSides) {
    if (groups.wrists[static_cast<std::size_t>(side)] == kNoJoint) continue;
    for (std::size_t joint = 0; joint < groups.of.size(); ++joint) {
      if (groups.of[joint] == arm_of(side)) groups.roles[joint] = JointRole::other_arm;
    }
    if (rig.has(of(side, Part::left_upper_arm))) role(rig[of(side, Part::left_upper_arm)].joint) = JointRole::shoulder;
    if (rig.has(of(side, Part::left_forearm))) role(rig[of(side, Part::left_forearm)].joint) = JointRole::elbow;
  }
  for (std::size_t joint = 0; joint < groups.of.size(); ++joint) {
    groups.all[static_cast<std::size_t>(groups.of[joint])].push_back(static_cast<JointIndex>(joint));
  }
  for (const JointIndex joint : skeleton.translated_joints()) groups.of_translation.push_back(at(joint));
  return groups;
}

}  // namespace signweave
