#include "signweave/transition/arm_reach.h"

#include <algorithm>
#include <cmath>

#include "signweave/motion/turn_between.h"

namespace signweave {
namespace {

/// An elbow is neither bent nor stretched farther than this by being shifted. Radians between the bones.
constexpr float kMostBent = 0.5f;
constexpr float kMostStretched = 3.1f;

std::size_t slot(JointIndex joint) {
  return static_cast<std::size_t>(joint);
}

Eigen::Quaternionf parent_rotation(const Skeleton& skeleton, const ModelPose& model, JointIndex joint) {
  const JointIndex parent = skeleton.joint(joint).parent;
  return parent == kNoJoint ? Eigen::Quaternionf::Identity() : model.rotations[slot(parent)];
}

}  // namespace

bool is_above(const Skeleton& skeleton, JointIndex upper, JointIndex lower) noexcept {
  for (JointIndex joint = skeleton.joint(lower).parent; joint != kNoJoint; joint = skeleton.joint(joint).parent) {
    if (joint == upper) return true;
  }
  return false;
}

void set_in_hemisphere(Eigen::Quaternionf& local, Eigen::Quaternionf to) noexcept {
  to.normalize();
  if (local.dot(to) < 0) to.coeffs() *= -1.0f;
  local = to;
}

void shift_wrist(const Skeleton& skeleton, const ArmJoints& arm, const ModelPose& model, const Eigen::Vector3f& by,
                 MutablePoseView pose) noexcept {
  const Eigen::Vector3f upper = model.positions[slot(arm.elbow)] - model.positions[slot(arm.shoulder)];
  const Eigen::Vector3f fore = model.positions[slot(arm.wrist)] - model.positions[slot(arm.elbow)];
  const float a = upper.norm();
  const float b = fore.norm();
  if (a < 1e-4f || b < 1e-4f) return;
  // Between the bones, seen from the elbow.
  const float angle = std::acos(std::clamp(-upper.dot(fore) / (a * b), -1.0f, 1.0f));
  const auto distance_at = [&](float between) {
    return std::sqrt(std::max(0.0f, a * a + b * b - 2 * a * b * std::cos(between)));
  };
  const Eigen::Vector3f goal = upper + fore + by;  // from the shoulder
  const float farthest = distance_at(std::max(kMostStretched, angle));
  const float nearest = distance_at(std::min(kMostBent, angle));
  const float distance = std::clamp(goal.norm(), nearest, farthest);
  if (distance < 1e-4f || goal.norm() < 1e-4f) return;
  const float wanted = std::acos(std::clamp((a * a + b * b - distance * distance) / (2 * a * b), -1.0f, 1.0f));
  Eigen::Vector3f axis = upper.cross(fore);  // turning the forearm about it bends the elbow more
  if (axis.norm() < 1e-4f * a * b) axis = upper.cross(goal);
  if (axis.norm() < 1e-6f) axis = upper.unitOrthogonal();
  axis.normalize();
  const Eigen::Quaternionf bend(Eigen::AngleAxisf(angle - wanted, axis));
  const Eigen::Vector3f reached = upper + bend * fore;
  const Eigen::Quaternionf turn = turn_between(reached, goal);

  const Eigen::Quaternionf before_elbow = parent_rotation(skeleton, model, arm.elbow);
  const Eigen::Quaternionf before_wrist = parent_rotation(skeleton, model, arm.wrist);
  set_in_hemisphere(pose.rotations[slot(arm.shoulder)], parent_rotation(skeleton, model, arm.shoulder).conjugate() *
                                                            turn * model.rotations[slot(arm.shoulder)]);
  set_in_hemisphere(pose.rotations[slot(arm.elbow)],
                    before_elbow.conjugate() * bend * model.rotations[slot(arm.elbow)]);
  set_in_hemisphere(pose.rotations[slot(arm.wrist)],
                    (turn * bend * before_wrist).conjugate() * model.rotations[slot(arm.wrist)]);
}

void swivel_elbow(const Skeleton& skeleton, const ArmJoints& arm, const ModelPose& model, float by,
                  MutablePoseView pose) noexcept {
  const Eigen::Vector3f line = model.positions[slot(arm.wrist)] - model.positions[slot(arm.shoulder)];
  const float length = line.norm();
  if (!(length > 1e-4f)) return;
  const Eigen::Quaternionf turn(Eigen::AngleAxisf(by, line / length));
  set_in_hemisphere(pose.rotations[slot(arm.shoulder)], parent_rotation(skeleton, model, arm.shoulder).conjugate() *
                                                            turn * model.rotations[slot(arm.shoulder)]);
  set_in_hemisphere(pose.rotations[slot(arm.wrist)], (turn * parent_rotation(skeleton, model, arm.wrist)).conjugate() *
                                                         model.rotations[slot(arm.wrist)]);
}

}  // namespace signweave
