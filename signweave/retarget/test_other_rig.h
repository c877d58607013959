#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "signweave/motion/kinematics.h"
#include "signweave/motion/motion.h"
#include "signweave/retarget/test_character.h"

/// For tests: the synthetic signer's recordings as if another lab had captured another person.
namespace signweave {

/// The differences of another rig.
struct OtherRig {
  std::string prefix = "mixamorig:";  ///< before each joint's name
  float arms = 0.93f;                 ///< lengths relative to the synthetic signer's
  float hands = 0.9f;
  float shoulders = 1.08f;
  float legs = 1.05f;
  float lowered = 0.7f;  ///< radians by which the arms are below the horizontal in the identity pose: an A-pose
  float turned = 1.2f;   ///< rotation of the body about the vertical, radians
};

/// Returns the same joint angles on bones of other lengths, with another identity pose, so that no value of a pose is
/// the same.
inline Motion on_other_rig(const Motion& motion, const OtherRig& how = {}) {
  std::vector<Joint> joints(motion.skeleton().joints().begin(), motion.skeleton().joints().end());
  std::vector<Tip> tips(motion.skeleton().tips().begin(), motion.skeleton().tips().end());
  const auto scale_of = [&](const std::string& name) {
    if (name.find("Hand") != std::string::npos && !name.ends_with("Hand")) return how.hands;
    if (name.ends_with("ForeArm") || name.ends_with("Hand")) return how.arms;
    if (name.ends_with("Arm")) return how.shoulders;
    if (name.ends_with("Leg") || name.ends_with("Foot")) return how.legs;
    return 1.0f;
  };
  for (Tip& tip : tips) tip.offset *= scale_of(joints[static_cast<std::size_t>(tip.joint)].name);
  for (Joint& joint : joints) joint.offset *= scale_of(joint.name);
  const Skeleton body(joints, tips);
  Pose rest(body);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::string& name = joints[i].name;
    const float side = name.starts_with("Left") ? -1.0f : 1.0f;
    if (name == "LeftArm" || name == "RightArm")
      rest.rotations[i] = Eigen::AngleAxisf(side * how.lowered, Eigen::Vector3f::UnitZ());
    if (name == "LeftForeArm" || name == "RightForeArm")
      rest.rotations[i] = Eigen::AngleAxisf(side * 0.2f, Eigen::Vector3f::UnitY());
  }
  rest.rotations[0] = Eigen::AngleAxisf(how.turned, Eigen::Vector3f::UnitY());
  const ModelPose stands = to_model_space(body, rest.view());
  const auto rested = rested_in(body, rest.view());
  std::vector<Joint> named(rested->joints().begin(), rested->joints().end());
  for (Joint& joint : named) joint.name = how.prefix + joint.name;
  Motion other(std::make_shared<const Skeleton>(std::move(named),
                                                std::vector<Tip>(rested->tips().begin(), rested->tips().end())),
               motion.rate(), motion.frame_count());
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const ModelPose from = to_model_space(motion.skeleton(), motion.pose(frame));
    const MutablePoseView to = other.pose(frame);
    std::vector<Eigen::Quaternionf> turns;
    for (std::size_t i = 0; i < joints.size(); ++i)
      turns.push_back(from.rotations[i] * stands.rotations[i].conjugate());
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const JointIndex parent = joints[i].parent;
      to.rotations[i] =
          parent == kNoJoint ? turns[i] : (turns[static_cast<std::size_t>(parent)].conjugate() * turns[i]).normalized();
    }
    to.translations[0] = motion.pose(frame).translations[0];
    to.translations[0].y() *= how.legs;
  }
  for (const ScalarTrack& track : motion.tracks()) other.add_track(track);
  keep_hemisphere(other);
  return other;
}

/// Returns the same motion below a root that does not move, as some programs write it: the old root moves below it.
inline Motion below_a_still_root(const Motion& motion) {
  std::vector<Joint> joints = {{"Reference", kNoJoint, Eigen::Vector3f::Zero(), true}};
  for (Joint joint : motion.skeleton().joints()) {
    joint.translated = joint.translated || joint.parent == kNoJoint;
    ++joint.parent;
    joints.push_back(std::move(joint));
  }
  std::vector<Tip> tips(motion.skeleton().tips().begin(), motion.skeleton().tips().end());
  for (Tip& tip : tips) ++tip.joint;
  Motion below(std::make_shared<const Skeleton>(std::move(joints), std::move(tips)), motion.rate(),
               motion.frame_count());
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const PoseView from = motion.pose(frame);
    std::ranges::copy(from.rotations, below.pose(frame).rotations.begin() + 1);
    std::ranges::copy(from.translations, below.pose(frame).translations.begin() + 1);
  }
  for (const ScalarTrack& track : motion.tracks()) below.add_track(track);
  return below;
}

/// Returns the motion without some joints and their descendants.
inline Motion without_joints(const Motion& motion, const std::vector<std::string>& names) {
  const Skeleton& skeleton = motion.skeleton();
  std::vector<JointIndex> now(skeleton.joint_count(), kNoJoint);
  std::vector<Joint> joints;
  for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
    Joint joint = skeleton.joints()[i];
    const bool gone = joint.parent != kNoJoint && now[static_cast<std::size_t>(joint.parent)] == kNoJoint;
    if (gone || std::ranges::find(names, joint.name) != names.end()) continue;
    if (joint.parent != kNoJoint) joint.parent = now[static_cast<std::size_t>(joint.parent)];
    now[i] = static_cast<JointIndex>(joints.size());
    joints.push_back(std::move(joint));
  }
  std::vector<Tip> tips;
  for (const Tip& tip : skeleton.tips()) {
    const JointIndex joint = now[static_cast<std::size_t>(tip.joint)];
    if (joint != kNoJoint) tips.push_back({joint, tip.offset});
  }
  Motion less(std::make_shared<const Skeleton>(std::move(joints), std::move(tips)), motion.rate(),
              motion.frame_count());
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now[i] != kNoJoint)
        less.pose(frame).rotations[static_cast<std::size_t>(now[i])] = motion.pose(frame).rotations[i];
    }
    for (std::size_t i = 0; i < skeleton.translation_count(); ++i) {
      const JointIndex joint = now[static_cast<std::size_t>(skeleton.translated_joints()[i])];
      if (joint == kNoJoint) continue;
      less.pose(frame).translations[*less.skeleton().translation_of(joint)] = motion.pose(frame).translations[i];
    }
  }
  for (const ScalarTrack& track : motion.tracks()) less.add_track(track);
  return less;
}

}  // namespace signweave
