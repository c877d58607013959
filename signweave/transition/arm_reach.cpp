#include "signweave/transition/arm_reach.h"

#include <algorithm>
#include <cmath>

#include "signweave/motion/turn_between.h"

namespace signweave {
namespace {

/// Limits of the elbow in a shift: cosines of 0.5 and 3.1 radians between the bones.
constexpr float kMostBent = 0.87758f;
constexpr float kStraightestCosine = -0.99914f;

std::size_t slot(JointIndex joint) {
  return static_cast<std::size_t>(joint);
}

Eigen::Quaternionf parent_rotation(const Skeleton& skeleton, const ModelPose& model, JointIndex joint) {
  const JointIndex parent = skeleton.joint(joint).parent;
  return parent == kNoJoint ? Eigen::Quaternionf::Identity() : model.rotations[slot(parent)];
}

/// The rotation about an axis by the difference of two angles in [0, π], given by their cosines.
Eigen::Quaternionf turn_by_difference(float of, float without, const Eigen::Vector3f& axis) noexcept {
  const float sine_of = std::sqrt(1 - of * of);
  const float sine_without = std::sqrt(1 - without * without);
  const float half = std::sqrt(std::max(0.0f, 0.5f * (1 + of * without + sine_of * sine_without)));  // its cosine
  if (half < 1e-3f) return Eigen::Quaternionf(Eigen::AngleAxisf(std::acos(of) - std::acos(without), axis));
  const Eigen::Vector3f turned = (sine_of * without - of * sine_without) / (2 * half) * axis;
  return {half, turned.x(), turned.y(), turned.z()};
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
  // The cosine of the angle between the bones at the elbow. The angles themselves are never needed.
  const float cosine = std::clamp(-upper.dot(fore) / (a * b), -1.0f, 1.0f);
  const auto distance_at = [&](float between) {
    return std::sqrt(std::max(0.0f, a * a + b * b - 2 * a * b * between));
  };
  const Eigen::Vector3f goal = upper + fore + by;  // from the shoulder
  const float farthest = distance_at(std::min(kStraightestCosine, cosine));
  const float nearest = distance_at(std::max(kMostBent, cosine));
  const float distance = std::clamp(goal.norm(), nearest, farthest);
  if (distance < 1e-4f || goal.norm() < 1e-4f) return;
  const float wanted = std::clamp((a * a + b * b - distance * distance) / (2 * a * b), -1.0f, 1.0f);
  Eigen::Vector3f axis = upper.cross(fore);  // rotating the forearm about it bends the elbow more
  if (axis.norm() < 1e-4f * a * b) axis = upper.cross(goal);
  if (axis.norm() < 1e-6f) axis = upper.unitOrthogonal();
  axis.normalize();
  const Eigen::Quaternionf bend = turn_by_difference(cosine, wanted, axis);
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
