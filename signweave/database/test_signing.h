#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "signweave/database/test_recording.h"

namespace signweave::testing_database {

/// A body whose right arm moves up and down, faster with a larger seed.
inline Motion signing(std::int64_t frames, int seed) {
  std::vector<Joint> joints = {{"Hips", kNoJoint, {0, 0.95f, 0}, true},
                               {"Spine", 0, {0, 0.2f, 0}, false},
                               {"Chest", 1, {0, 0.2f, 0}, false},
                               {"Neck", 2, {0, 0.15f, 0}, false},
                               {"Head", 3, {0, 0.08f, 0.01f}, false}};
  std::vector<Tip> tips = {{4, {0, 0.2f, 0}}};
  for (const float side : {1.0f, -1.0f}) {
    const std::string name = side > 0 ? "Left" : "Right";
    const auto add = [&](const char* part, float length) {
      const auto parent = static_cast<JointIndex>(joints.size()) - 1;
      joints.push_back({name + part, parent, {side * length, 0, 0}, false});
    };
    joints.push_back({name + "Shoulder", 2, {side * 0.03f, 0.1f, 0}, false});
    add("Arm", 0.15f);
    add("ForeArm", 0.28f);
    add("Hand", 0.25f);
    tips.push_back({static_cast<JointIndex>(joints.size()) - 1, {side * 0.15f, 0, 0}});
  }
  for (const float side : {1.0f, -1.0f}) {
    const std::string name = side > 0 ? "Left" : "Right";
    joints.push_back({name + "UpLeg", 0, {side * 0.09f, -0.05f, 0}, false});
    const auto hip = static_cast<JointIndex>(joints.size()) - 1;
    joints.push_back({name + "Leg", hip, {0, -0.42f, 0}, false});
    joints.push_back({name + "Foot", hip + 1, {0, -0.4f, 0}, false});
    tips.push_back({hip + 2, {0, -0.06f, 0.16f}});
  }
  Motion motion(std::make_shared<const Skeleton>(std::move(joints), std::move(tips)), {100, 1}, frames);
  const auto arm = static_cast<std::size_t>(*motion.skeleton().find("RightArm"));
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const float angle = 0.6f + 0.4f * std::sin(0.05f * static_cast<float>((seed + 1) * frame));
    motion.pose(frame).rotations[arm] = Eigen::AngleAxisf(angle, Eigen::Vector3f::UnitZ());
  }
  return motion;
}

inline Recording recording_of(const std::string& name, int seed, const std::vector<std::string>& glosses) {
  Recording recording = small_recording(name, seed, glosses);
  recording.motion->motion = signing(300, seed);
  return recording;
}

}  // namespace signweave::testing_database
