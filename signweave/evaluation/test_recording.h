#pragma once

// For tests: a body whose arms swing by given functions.

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "signweave/evaluation/evaluation.h"
#include "signweave/rig/rig_map.h"
#include "signweave/rig/test_rigs.h"

namespace signweave {

inline RigNaming whole_naming() {
  RigNaming naming;
  for (const char* const finger : {"Thumb", "Index", "Middle", "Ring", "Pinky"}) {
    std::vector<std::string> joints;
    for (int i = 1; i <= 3; ++i) joints.push_back(std::string("@Hand") + finger + std::to_string(i));
    naming.fingers.push_back(std::move(joints));
  }
  return naming;
}

/// Rotation of an arm about the shoulder in radians, by time.
using Swing = std::function<double(double seconds)>;

/// Arms hang and swing forwards; fingers bend half as far.
inline Motion swinging(const Swing& left, const Swing& right, std::int64_t frames, FrameRate rate = {60, 1}) {
  const Motion body = rig_body(whole_naming(), 1);
  Motion motion(body.shared_skeleton(), rate);
  const Skeleton& skeleton = body.skeleton();
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    motion.append(body.pose(0));
    MutablePoseView pose = motion.pose(frame);
    const double seconds = static_cast<double>(frame) * rate.frame_time().count();
    for (const bool is_left : {true, false}) {
      const auto angle = static_cast<float>((is_left ? left : right)(seconds));
      const std::string side = is_left ? "Left" : "Right";
      const float s = is_left ? 1.0f : -1.0f;
      const Eigen::Quaternionf down(Eigen::AngleAxisf(-1.2f * s, Eigen::Vector3f::UnitZ()));
      const auto turn = [&](const std::string& name) -> Eigen::Quaternionf& {
        return pose.rotations[static_cast<std::size_t>(*skeleton.find(name))];
      };
      turn(side + "Arm") = Eigen::AngleAxisf(-angle, Eigen::Vector3f::UnitX()) * down;
      turn(side + "HandIndex2") = Eigen::Quaternionf(Eigen::AngleAxisf(-0.5f * angle * s, Eigen::Vector3f::UnitZ()));
    }
  }
  return motion;
}

inline EvaluatedMotion recording_of(std::string name, Motion motion, std::vector<Sign> signs = {}) {
  const FrameClock clock{motion.rate().frame_time(), Seconds(0)};
  const RigMap rig = map_rig(motion);
  return evaluated_motion(std::move(name), std::move(motion), rig, std::move(signs), clock);
}

/// Swings of several amplitudes and speeds that never repeat, different for each `seed`.
inline EvaluatedMotion lively(std::string name, double seed, std::int64_t frames = 900) {
  const auto swing = [](double shift) {
    return [shift](double t) {
      return 0.6 + 0.5 * std::sin(5.1 * t + shift) + 0.25 * std::sin(8.3 * t + 2.0 * shift) +
             0.1 * std::sin(2.2 * t + 3.0 * shift);
    };
  };
  return recording_of(std::move(name), swinging(swing(seed), swing(seed + 1.3), frames));
}

}  // namespace signweave
