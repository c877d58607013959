#pragma once

#include <functional>
#include <vector>

#include "demo/plan.h"

namespace signweave::demo {

/// Trunk, head and eyes in one frame. Radians and metres, model space; positive angles turn to the signer's left, lean
/// forward, tilt to the right.
struct BodyFrame {
  Eigen::Vector3f hips = Eigen::Vector3f::Zero();  ///< offset from the rest pose
  double hips_yaw = 0, hips_roll = 0;
  double yaw = 0, pitch = 0, roll = 0;                 ///< of the chest relative to the hips
  double breath = 0;                                   ///< −1 (out) to 1
  double head_yaw = 0, head_pitch = 0, head_roll = 0;  ///< of the head, independent of the trunk
  Eigen::Vector3f look = Eigen::Vector3f::UnitZ();     ///< unit: direction of the gaze
};

/// The body of a recording, [frame]: the trunk follows the hands with a lag and shifts its weight between sentences;
/// the eyes jump to the hands or the viewer, and the head follows them and nods at the end of a sentence.
std::vector<BodyFrame> move_body(const Timeline& timeline, const HandPlan& plan, Random& random);
/// The same for wrists given by a function: metres, model space.
using WristPath = std::function<Eigen::Vector3f(Side side, double frame)>;
std::vector<BodyFrame> move_body(const Timeline& timeline, const WristPath& wrist, Random& random);

}  // namespace signweave::demo
