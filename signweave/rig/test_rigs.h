#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/motion/motion.h"

namespace signweave {

/// For tests: the joint names of one rig. `@` is the side; an empty name leaves a joint out. More than fifteen
/// members: one per joint.
struct RigNaming {
  std::string left = "Left", right = "Right";
  std::string hips = "Hips", spine = "Spine", chest = "Spine1", neck = "Neck", head = "Head";
  std::string collar = "@Shoulder", arm = "@Arm", elbow = "@ForeArm", hand = "@Hand";
  std::string thigh = "@UpLeg", knee = "@Leg", foot = "@Foot", toes = "@ToeBase";
  std::vector<std::vector<std::string>> fingers = {};  ///< thumb first; the joints of each finger
};

/// A person of 1.7 m who stands upright with the arms out and faces along z; every part has a realistic place. The
/// fingers are slightly bent, as in a relaxed hand.
inline Motion rig_body(const RigNaming& naming, std::int64_t frames = 1) {
  std::vector<Joint> joints;
  std::vector<Tip> tips;
  const auto last = [&] { return static_cast<JointIndex>(joints.size()) - 1; };
  const auto add = [&](std::string name, JointIndex parent, const Eigen::Vector3f& offset) {
    if (name.empty()) return parent;
    joints.push_back({std::move(name), parent, offset, joints.empty()});
    return last();
  };
  const JointIndex hips = add(naming.hips, kNoJoint, {0, 0.95f, 0});
  const JointIndex spine = add(naming.spine, hips, {0, 0.1f, 0});
  const JointIndex chest = add(naming.chest, spine, {0, 0.2f, 0});
  const JointIndex neck = add(naming.neck, chest, {0, 0.22f, 0});
  const JointIndex head = add(naming.head, neck, {0, 0.09f, 0.01f});
  tips.push_back({head, {0, 0.2f, 0}});
  for (const float s : {1.0f, -1.0f}) {
    const auto sided = [&](std::string name) {
      const std::size_t place = name.find('@');
      return place == std::string::npos ? name : name.replace(place, 1, s > 0 ? naming.left : naming.right);
    };
    const JointIndex collar = add(sided(naming.collar), chest, {0.03f * s, 0.17f, 0});
    const JointIndex arm = add(sided(naming.arm), collar, {0.15f * s, 0, 0});
    const JointIndex elbow = add(sided(naming.elbow), arm, {0.28f * s, 0, 0});
    const JointIndex hand = add(sided(naming.hand), elbow, {0.25f * s, 0, 0});
    for (std::size_t f = 0; f < naming.fingers.size(); ++f) {
      JointIndex on = hand;
      const std::size_t count = naming.fingers[f].size();
      for (std::size_t i = 0; i < count; ++i) {
        const float z = f == 0 ? 0.03f : 0.045f - 0.02f * static_cast<float>(f);
        const bool palm = count > 3 && f > 0;
        Eigen::Vector3f offset = {0.09f * s, 0, z};
        if (f == 0) offset = {0.03f * s, -0.01f, z};
        if (palm && i == 0) offset = {0.02f * s, 0, z};
        if (palm && i == 1) offset = {0.07f * s, 0, 0};
        if (i > (palm ? 1u : 0u))
          offset = f == 0 ? Eigen::Vector3f(0.03f * s, -0.01f, 0.015f) : Eigen::Vector3f(0.03f * s, -0.01f, 0);
        on = add(sided(naming.fingers[f][i]), on, offset);
      }
      if (count > 0) tips.push_back({on, {0.02f * s, -0.01f, 0}});
    }
  }
  for (const float s : {1.0f, -1.0f}) {
    const auto sided = [&](std::string name) {
      const std::size_t place = name.find('@');
      return place == std::string::npos ? name : name.replace(place, 1, s > 0 ? naming.left : naming.right);
    };
    const JointIndex thigh = add(sided(naming.thigh), hips, {0.09f * s, -0.05f, 0});
    const JointIndex knee = add(sided(naming.knee), thigh, {0, -0.42f, 0});
    const JointIndex foot = add(sided(naming.foot), knee, {0, -0.4f, 0});
    const JointIndex toes = add(sided(naming.toes), foot, {0, -0.06f, 0.13f});
    tips.push_back({toes, {0, 0, 0.06f}});
  }
  return Motion(std::make_shared<const Skeleton>(std::move(joints), std::move(tips)), {100, 1}, frames);
}

/// The same motion with other joint names.
inline Motion renamed(const Motion& motion, std::string_view prefix) {
  std::vector<Joint> joints(motion.skeleton().joints().begin(), motion.skeleton().joints().end());
  for (std::size_t i = 0; i < joints.size(); ++i)
    joints[i].name = std::string(prefix) + std::to_string(i * 7919 % 1009);
  const auto tips = motion.skeleton().tips();
  Motion copy(std::make_shared<const Skeleton>(std::move(joints), std::vector<Tip>(tips.begin(), tips.end())),
              motion.rate(), 0);
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) copy.append(motion.pose(frame));
  return copy;
}

}  // namespace signweave
