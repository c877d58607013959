#include "signweave/retarget/collar.h"

#include <algorithm>
#include <cmath>

#include "signweave/motion/degree.h"
#include "signweave/retarget/drives.h"

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3f;

/// The fractions that the clavicle takes of the arm's elevation above 35° below the horizontal, and of its rotation
/// forward past 25° from the side; and the maximum angles. (ours; roughly what is known of shoulders)
constexpr float kLift = 0.25f;
constexpr float kLiftFrom = -35 * kDegree;
constexpr float kMostLift = 24 * kDegree;
constexpr float kForward = 0.20f;
constexpr float kForwardFrom = 25 * kDegree;
constexpr float kMostForward = 20 * kDegree;
/// The angle over which a share sets in.
constexpr float kSoft = 12 * kDegree;

/// Returns 0 below 0, the value above, smooth in between.
float softened(float value) {
  if (value <= -kSoft) return 0;
  if (value >= kSoft) return value;
  return (value + kSoft) * (value + kSoft) / (4 * kSoft);
}

/// Limits a value smoothly to `most`.
float held(float value, float most) {
  return most * std::tanh(value / most);
}

}  // namespace

std::optional<CharacterCollar> CharacterCollar::make(const Character& character, const RigAxes& axes, Side side) {
  const RigMap& rig = character.rig;
  const Part collar = of(side, Part::left_clavicle);
  const Part shoulder = of(side, Part::left_upper_arm);
  const Part elbow = of(side, Part::left_forearm);
  if (!rig.has(collar) || !rig.has(shoulder) || !rig.has(elbow)) return std::nullopt;
  const Skeleton& skeleton = *character.skeleton;
  CharacterCollar made;
  made.side_ = side == Side::left ? 1.0f : -1.0f;
  made.bones_ = path_between(skeleton, rig[collar].joint, rig[shoulder].joint);
  if (made.bones_.size() < 2) return std::nullopt;
  made.bones_.pop_back();
  made.chest_ = skeleton.joint(rig[collar].joint).parent;
  if (made.chest_ == kNoJoint) return std::nullopt;
  made.arm_ = rig[shoulder].joint;
  made.arm_axis_ = (axes.place(elbow) - axes.place(shoulder)).normalized();
  made.trunk_ = axes.trunk();
  for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
    const auto joint = static_cast<JointIndex>(i);
    if (joint != rig[collar].joint && !path_between(skeleton, rig[collar].joint, joint).empty()) {
      made.below_.push_back(joint);
    }
  }
  return made;
}

void CharacterCollar::apply(const Skeleton& skeleton, ModelPose& pose) const noexcept {
  const auto at = [](JointIndex joint) { return static_cast<std::size_t>(joint); };
  const Quaternionf chest = pose.rotations[at(chest_)] * trunk_;
  // Components: up, left, back.
  const Vector3f arm = chest.conjugate() * (pose.rotations[at(arm_)] * arm_axis_);
  const float height = std::asin(std::clamp(arm.x(), -1.0f, 1.0f));
  const float level = std::hypot(arm.y(), arm.z());
  const float forward = std::atan2(-arm.z(), side_ * arm.y());
  const float lift = held(kLift * softened(height - kLiftFrom), kMostLift);
  // A vertical arm has no direction about the vertical.
  const float ahead = level * held(kForward * softened(forward - kForwardFrom), kMostForward);
  const Quaternionf turn = chest * AngleAxisf(side_ * lift, -Vector3f::UnitZ()) *
                           AngleAxisf(-side_ * ahead, Vector3f::UnitX()) * chest.conjugate();
  for (const JointIndex bone : bones_) pose.rotations[at(bone)] = (turn * pose.rotations[at(bone)]).normalized();
  for (const JointIndex joint : below_) {
    const Joint& own = skeleton.joint(joint);
    pose.positions[at(joint)] = pose.positions[at(own.parent)] + pose.rotations[at(own.parent)] * own.offset;
  }
}

}  // namespace signweave
