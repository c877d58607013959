#pragma once

#include <memory>
#include <string>
#include <vector>

#include "signweave/motion/motion.h"

namespace signweave {

/// For tests: a person of 1.7 m who faces along z in the rest pose, arms out, with four fingers per hand.
inline std::shared_ptr<const Skeleton> person() {
  std::vector<Joint> joints = {{"Hips", kNoJoint, {0, 0.95f, 0}, true}, {"Spine", 0, {0, 0.2f, 0}, false},
                               {"Chest", 1, {0, 0.15f, 0}, false},      {"Neck", 2, {0, 0.2f, 0}, false},
                               {"Head", 3, {0, 0.06f, 0}, false},       {"Jaw", 4, {0, 0.02f, 0.03f}, false}};
  std::vector<Tip> tips = {{4, {0, 0.2f, 0}}, {5, {0, -0.03f, 0.06f}}};
  const auto last = [&] { return static_cast<JointIndex>(joints.size()) - 1; };
  for (const float side : {1.0f, -1.0f}) {
    const std::string name = side > 0 ? "Left" : "Right";
    joints.push_back({name + "Shoulder", 2, {0.03f * side, 0.15f, 0}, false});
    joints.push_back({name + "Arm", last(), {0.15f * side, 0, 0}, false});
    joints.push_back({name + "ForeArm", last(), {0.28f * side, 0, 0}, false});
    joints.push_back({name + "Hand", last(), {0.25f * side, 0, 0}, false});
    const JointIndex hand = last();
    for (int finger = 0; finger < 4; ++finger) {
      joints.push_back({name + "Finger", hand, {0.09f * side, 0, 0.02f * static_cast<float>(finger) - 0.03f}, false});
      joints.push_back({name + "Finger", last(), {0.04f * side, 0, 0}, false});
      tips.push_back({last(), {0.03f * side, 0, 0}});
    }
  }
  for (const float side : {1.0f, -1.0f}) {
    const std::string name = side > 0 ? "Left" : "Right";
    joints.push_back({name + "UpLeg", 0, {0.09f * side, -0.05f, 0}, false});
    joints.push_back({name + "Leg", last(), {0, -0.42f, 0}, false});
    joints.push_back({name + "Foot", last(), {0, -0.4f, 0}, false});
    tips.push_back({last(), {0, -0.06f, 0.16f}});
  }
  return std::make_shared<const Skeleton>(std::move(joints), std::move(tips));
}

/// A moving person: every joint turns a little, differently from frame to frame.
inline Motion moving_person(std::int64_t frames) {
  Motion motion(person(), {100, 1}, frames);
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const auto pose = motion.pose(frame);
    for (std::size_t joint = 0; joint < pose.rotations.size(); ++joint) {
      const float angle = 0.3f * std::sin(0.7f * static_cast<float>(joint) + 0.2f * static_cast<float>(frame));
      pose.rotations[joint] = Eigen::AngleAxisf(angle, Eigen::Vector3f(1, 0.5f, -0.3f).normalized());
    }
    pose.translations[0] += Eigen::Vector3f(0.01f * static_cast<float>(frame), 0, 0);
  }
  return motion;
}

}  // namespace signweave
