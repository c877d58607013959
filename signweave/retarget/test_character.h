#pragma once

// For tests: characters built by hand from small skeletons.

#include <algorithm>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "signweave/features/hand_motion.h"
#include "signweave/motion/kinematics.h"
#include "signweave/retarget/character.h"
#include "signweave/rig/test_rig.h"

namespace signweave {

/// Returns the same body with `pose` as its identity pose: joints keep their positions, and no joint is rotated.
inline std::shared_ptr<const Skeleton> rested_in(const Skeleton& skeleton, PoseView pose) {
  const ModelPose placed = to_model_space(skeleton, pose);
  std::vector<Joint> joints(skeleton.joints().begin(), skeleton.joints().end());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const JointIndex parent = joints[i].parent;
    joints[i].offset = placed.positions[i];
    if (parent != kNoJoint) joints[i].offset -= placed.positions[static_cast<std::size_t>(parent)];
    joints[i].translated = parent == kNoJoint;
  }
  std::vector<Tip> tips(skeleton.tips().begin(), skeleton.tips().end());
  for (Tip& tip : tips) tip.offset = placed.rotations[static_cast<std::size_t>(tip.joint)] * tip.offset;
  return std::make_shared<const Skeleton>(std::move(joints), std::move(tips));
}

/// Adds a joint halfway to each named joint, which rotates the rest of that bone: "LeftHand" gets "LeftHandTwist"
/// before it.
inline std::shared_ptr<const Skeleton> with_twist(const Skeleton& skeleton, const std::vector<std::string>& before) {
  std::vector<Joint> joints;
  std::map<JointIndex, JointIndex> moved;
  for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
    Joint joint = skeleton.joints()[i];
    joint.parent = joint.parent == kNoJoint ? kNoJoint : moved.at(joint.parent);
    if (std::find(before.begin(), before.end(), joint.name) != before.end()) {
      joint.offset *= 0.5f;
      joints.push_back({joint.name + "Twist", joint.parent, joint.offset, false});
      joint.parent = static_cast<JointIndex>(joints.size()) - 1;
    }
    joints.push_back(joint);
    moved[static_cast<JointIndex>(i)] = static_cast<JointIndex>(joints.size()) - 1;
  }
  std::vector<Tip> tips(skeleton.tips().begin(), skeleton.tips().end());
  for (Tip& tip : tips) tip.joint = moved.at(tip.joint);
  return std::make_shared<const Skeleton>(std::move(joints), std::move(tips));
}

/// Returns a character with wide limits from a skeleton with the names of `whole_person`. Fingers bend about z and
/// spread about y, as in a palm that faces down.
inline Character character_of(std::shared_ptr<const Skeleton> skeleton) {
  Character character;
  character.name = "made";
  character.skeleton = std::move(skeleton);
  character.rig = rig_of_signer(*character.skeleton);
  character.body = signer_body(Motion(character.skeleton, {30, 1}, 1), character.rig);
  character.height = 1.7f;
  for (const Side side : kSides) {
    CharacterHand& hand = character.hands[static_cast<std::size_t>(side)];
    hand.length = 0.17f;
    for (const Finger finger : kFingers) {
      CharacterFinger& own = hand.fingers[static_cast<std::size_t>(finger)];
      for (std::size_t i = 0; i < 3; ++i) {
        own.joints[i] = character.rig[finger_part(side, finger, static_cast<FingerPoint>(i + 1))].joint;
        own.flexion[i] = {-std::numbers::pi_v<float>, std::numbers::pi_v<float>};
      }
      own.spread = own.flexion[0];
      own.flexion_axis = Eigen::Vector3f(0, 0, side == Side::left ? -1.0f : 1.0f);
      own.spread_axis = Eigen::Vector3f(0, side == Side::left ? -1.0f : 1.0f, 0);
    }
  }
  return character;
}

/// Returns the model of a motion of such a skeleton.
inline SignerModel plain_model_of(const Motion& motion) {
  SignerModel model{.rig = rig_of_signer(motion.skeleton()), .body = {}};
  model.body = signer_body(motion, model.rig);
  return model;
}

}  // namespace signweave
