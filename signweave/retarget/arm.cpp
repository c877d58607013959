#include "signweave/retarget/arm.h"

#include "signweave/retarget/angles.h"
#include "signweave/rig/joint_at.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3f;

/// The fraction of the hand's twist about the forearm that the forearm's first and last joint take; joints between are
/// interpolated.
constexpr float kTwistAtElbow = 0.2f;
constexpr float kTwistAtWrist = 0.75f;
/// The fraction of the arm's twist that the first of several joints takes; the last takes all.
constexpr float kTwistAtShoulder = 0.4f;
/// Below the first angle a bent elbow does not determine its plane; above the second it does.
constexpr float kPlaneFrom = 8 * std::numbers::pi_v<float> / 180;
constexpr float kPlaneTo = 30 * std::numbers::pi_v<float> / 180;
/// No arm is completely straight: beyond this fraction of its length the bend would jump.
constexpr float kReach = 0.9998f;

float share_of(std::size_t i, std::size_t count, float first, float last) {
  if (count < 2) return last;
  return first + (last - first) * static_cast<float>(i) / static_cast<float>(count - 1);
}

}  // namespace

float twist_about(const Quaternionf& turn, const Vector3f& axis) noexcept {
  const float angle = 2 * std::atan2(turn.vec().dot(axis), turn.w());
  return std::remainder(angle, 2 * std::numbers::pi_v<float>);
}

TwoBones reach(const TwoBones& bones, float upper_length, float lower_length, const Vector3f& goal,
               const Vector3f& bend) noexcept {
  const float most = kReach * (upper_length + lower_length);
  const float least = 1.05f * std::abs(upper_length - lower_length) + 0.01f * most;
  const float far = std::clamp(goal.norm(), least, most);
  // The angle at the elbow, by the law of cosines: 0 is straight.
  const float inner =
      (far * far - upper_length * upper_length - lower_length * lower_length) / (2 * upper_length * lower_length);
  const float bent = std::acos(std::clamp(inner, -1.0f, 1.0f));
  const float now = angle(bones.upper, bones.lower);
  const Vector3f shown = across(bones.lower, bones.upper);
  const float weight = smooth_step(now, 0.02f, 0.1f);
  Vector3f side = weight * (shown.norm() > 1e-6f ? Vector3f(shown.normalized()) : Vector3f(Vector3f::Zero())) +
                  (1 - weight) * across(bend, bones.upper).normalized();
  side = across(side, bones.upper);
  side = side.norm() > 1e-6f ? Vector3f(side.normalized()) : Vector3f(bones.upper.unitOrthogonal());
  const Vector3f lower = std::cos(bent) * bones.upper + std::sin(bent) * side;
  const Vector3f end = upper_length * bones.upper + lower_length * lower;
  const Quaternionf turn = goal.norm() > 1e-6f ? turn_between(end, goal) : Quaternionf::Identity();
  return {turn * bones.upper, turn * lower};
}

std::optional<CharacterArm> CharacterArm::make(const Character& character, const RigAxes& axes, Side side) {
  const RigMap& rig = character.rig;
  const Part shoulder = of(side, Part::left_upper_arm);
  const Part elbow = of(side, Part::left_forearm);
  const Part wrist = of(side, Part::left_hand);
  if (!rig.has(shoulder) || !rig.has(elbow) || !rig.has(wrist)) return std::nullopt;
  CharacterArm arm;
  arm.upper_ = path_between(*character.skeleton, rig[shoulder].joint, rig[elbow].joint);
  arm.lower_ = path_between(*character.skeleton, rig[elbow].joint, rig[wrist].joint);
  if (arm.upper_.size() < 2 || arm.lower_.size() < 2) return std::nullopt;
  arm.upper_.pop_back();
  arm.lower_.pop_back();
  arm.wrist_ = rig[wrist].joint;
  arm.parent_ = character.skeleton->joint(arm.upper_.front()).parent;
  const Vector3f upper = axes.place(elbow) - axes.place(shoulder);
  const Vector3f lower = axes.place(wrist) - axes.place(elbow);
  arm.upper_length_ = upper.norm();
  arm.lower_length_ = lower.norm();
  if (arm.upper_length_ < 1e-4f || arm.lower_length_ < 1e-4f) return std::nullopt;
  arm.upper_axis_ = upper.normalized();
  arm.lower_axis_ = lower.normalized();
  arm.upper_bend_ = axes[shoulder] * Vector3f::UnitY();
  arm.lower_bend_ = axes[elbow] * Vector3f::UnitY();
  return arm;
}

void CharacterArm::update_positions(const Skeleton& skeleton, ModelPose& pose) const {
  const auto put = [&](JointIndex joint) {
    const Joint& own = skeleton.joint(joint);
    pose.positions[at(joint)] = pose.positions[at(own.parent)] + pose.rotations[at(own.parent)] * own.offset;
  };
  for (std::size_t i = 1; i < upper_.size(); ++i) put(upper_[i]);
  for (const JointIndex joint : lower_) put(joint);
  put(wrist_);
}

void CharacterArm::solve(const Skeleton& skeleton, const std::optional<Vector3f>& goal, Twist twist,
                         ModelPose& pose) const {
  const Quaternionf source_upper = pose.rotations[at(upper_.back())];
  const Quaternionf source_lower = pose.rotations[at(lower_.front())];
  const TwoBones source = {source_upper * upper_axis_, source_lower * lower_axis_};
  const Quaternionf above = parent_ == kNoJoint ? Quaternionf::Identity() : pose.rotations[at(parent_)];
  const Quaternionf hand = pose.rotations[at(wrist_)];
  // Saved, so that each round starts from the source's rotations.
  std::array<Quaternionf, 8> upper_source;
  std::array<Quaternionf, 8> lower_source;
  for (std::size_t i = 0; i < std::min<std::size_t>(upper_.size(), 8); ++i)
    upper_source[i] = pose.rotations[at(upper_[i])];
  for (std::size_t i = 0; i < std::min<std::size_t>(lower_.size(), 8); ++i)
    lower_source[i] = pose.rotations[at(lower_[i])];

  // Bones with several joints are not completely straight, so twist moves their end: the remaining error is added to
  // the goal.
  Vector3f aim = upper_length_ * source.upper + lower_length_ * source.lower;
  const int rounds = goal ? 4 : 1;
  for (int round = 0; round < rounds; ++round) {
    const TwoBones bones =
        round > 0 ? reach(source, upper_length_, lower_length_, aim, source_upper * upper_bend_) : source;
    const Quaternionf turned = turn_between(source.upper, bones.upper);
    const Quaternionf bent = turn_between(turned * source.lower, bones.lower) * turned;
    if (twist.upper) {
      for (std::size_t i = 0; i < upper_.size(); ++i)
        pose.rotations[at(upper_[i])] = turned * upper_source[std::min<std::size_t>(i, 7)];
    } else {
      // The elbow is a hinge: if it is bent, its plane determines the twist of the upper arm.
      const float weight = smooth_step(angle(bones.upper, bones.lower), kPlaneFrom, kPlaneTo);
      const Vector3f shown = across(bones.lower, bones.upper);
      const Vector3f kept = across(turned * (source_upper * upper_bend_), bones.upper).normalized();
      Vector3f side = (1 - weight) * kept;
      if (shown.norm() > 1e-6f) side += weight * shown.normalized();
      const Quaternionf whole = axes_along(bones.upper, side) * axes_along(upper_axis_, upper_bend_).conjugate();
      const Quaternionf local = above.conjugate() * whole;
      const float about = twist_about(local, upper_axis_);
      for (std::size_t i = 0; i < upper_.size(); ++i) {
        const float back = (share_of(i, upper_.size(), kTwistAtShoulder, 1) - 1) * about;
        pose.rotations[at(upper_[i])] = whole * Quaternionf(AngleAxisf(back, upper_axis_));
      }
    }
    if (twist.lower) {
      for (std::size_t i = 0; i < lower_.size(); ++i)
        pose.rotations[at(lower_[i])] = bent * lower_source[std::min<std::size_t>(i, 7)];
    } else {
      // The forearm as rotated by the hinge alone, then its share of the hand's twist.
      const Quaternionf upper = pose.rotations[at(upper_.back())];
      const Quaternionf hinged = turn_between(upper * lower_axis_, bones.lower) * upper;
      const float about = twist_about(hinged.conjugate() * hand, lower_axis_);
      for (std::size_t i = 0; i < lower_.size(); ++i) {
        const float share = share_of(i, lower_.size(), kTwistAtElbow, kTwistAtWrist);
        pose.rotations[at(lower_[i])] = hinged * Quaternionf(AngleAxisf(share * about, lower_axis_));
      }
    }
    update_positions(skeleton, pose);
    if (goal) aim += *goal - pose.positions[at(wrist_)];
  }
}

}  // namespace signweave
