#include "signweave/retarget/fingers.h"

#include <algorithm>
#include <cmath>

#include "signweave/retarget/angles.h"
#include "signweave/retarget/arm.h"
#include "signweave/rig/joint_at.h"

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3f;

/// Tips closer to the thumb's tip than the first distance are moved to the source's distance; beyond the second they
/// follow their bones. Metres for a hand of the character's size.
constexpr float kPinched = 0.018f;
constexpr float kApart = 0.055f;
/// The thumb's fraction of the correction.
constexpr float kThumbShare = 0.5f;

}  // namespace

CharacterFingers::CharacterFingers(const Character& character, const RigMap& source_rig, Side side)
    : fingers_(character.hand(side).fingers) {
  for (std::size_t i = 0; i < character.skeleton->joint_count(); ++i) still_.push_back(character.still_turn(i));
  const RigMap& rig = character.rig;
  const JointIndex wrist = rig[of(side, Part::left_hand)].joint;
  const Skeleton& skeleton = *character.skeleton;
  for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
    const auto joint = static_cast<JointIndex>(i);
    if (joint != wrist && !path_between(skeleton, wrist, joint).empty()) below_.push_back(joint);
  }
  for (const Finger finger : kFingers) {
    for (const FingerPoint which : {FingerPoint::proximal, FingerPoint::intermediate, FingerPoint::tip}) {
      const Part part = finger_part(side, finger, which);
      if (!rig.has(part) || !source_rig.has(part)) continue;
      const Point point = {rig[part], source_rig[part]};
      points_[count_++] = point;
      if (which == FingerPoint::tip) tips_[static_cast<std::size_t>(finger)] = point;
    }
  }
}

void CharacterFingers::limit(const CharacterFinger& finger, std::size_t i, const Skeleton& skeleton,
                             ModelPose& pose) const noexcept {
  const JointIndex joint = finger.joints[i];
  const Quaternionf parent = pose.rotations[at(skeleton.joint(joint).parent)];
  const Quaternionf local = parent.conjugate() * pose.rotations[at(joint)];
  const float flexion = twist_about(local, finger.flexion_axis);
  const float bounded = std::clamp(flexion, finger.flexion[i].least - finger.rest_flexion[i],
                                   finger.flexion[i].greatest - finger.rest_flexion[i]);
  // The rotation without the flexion: spread, and rotations that fingers do not have.
  Quaternionf swing = local * Quaternionf(AngleAxisf(-flexion, finger.flexion_axis));
  const AngleLimits sideways = i == 0 ? finger.spread : AngleLimits{-finger.slack, finger.slack};
  const float spread = twist_about(swing, finger.spread_axis);
  const float held = std::clamp(spread, sideways.least, sideways.greatest);
  if (bounded == flexion && held == spread) return;
  if (held != spread) swing = swing * Quaternionf(AngleAxisf(held - spread, finger.spread_axis));
  pose.rotations[at(joint)] = (parent * swing * Quaternionf(AngleAxisf(bounded, finger.flexion_axis))).normalized();
}

void CharacterFingers::update_positions(const CharacterFinger& finger, const Skeleton& skeleton,
                                        ModelPose& pose) const noexcept {
  for (const JointIndex index : finger.joints) {
    const Joint& joint = skeleton.joint(index);
    pose.positions[at(index)] = pose.positions[at(joint.parent)] + pose.rotations[at(joint.parent)] * joint.offset;
  }
}

void CharacterFingers::constrain(const Skeleton& skeleton, const Drives& drives, ModelPose& pose) const noexcept {
  for (const JointIndex joint : below_) {
    const auto parent = at(skeleton.joint(joint).parent);
    if (!drives.joints[at(joint)].driven()) pose.rotations[at(joint)] = pose.rotations[parent] * still_[at(joint)];
    for (const CharacterFinger& finger : fingers_) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (finger.joints[i] == joint && drives.joints[at(joint)].driven()) limit(finger, i, skeleton, pose);
      }
    }
    pose.positions[at(joint)] = pose.positions[parent] + pose.rotations[parent] * skeleton.joint(joint).offset;
  }
}

void CharacterFingers::pinch(const Skeleton& skeleton, const ModelPose& source, const Quaternionf& target_from_source,
                             float scale, ModelPose& pose) const noexcept {
  const CharacterFinger& thumb = fingers_[0];
  if (!tips_[0] || !thumb.known()) return;
  // Several rounds: each rotation of the thumb moves its tip away from the other fingers' goals.
  const auto turn = [&](const CharacterFinger& finger, const PartPlace& tip, const Vector3f& by) {
    const Vector3f end = position_of(tip, pose);
    // Distributed over the first two joints, so that neither rotates much.
    for (std::size_t k = 0; k < 2; ++k) {
      const Vector3f at_joint = pose.positions[at(finger.joints[k])];
      const Vector3f arm = position_of(tip, pose) - at_joint;
      const Vector3f goal = k == 0 ? Vector3f(arm + 0.5f * by) : Vector3f(end + by - at_joint);
      if (arm.norm() < 1e-4f || goal.norm() < 1e-4f) return;
      const Quaternionf turned = turn_between(arm, goal);
      for (std::size_t i = k; i < 3; ++i)
        pose.rotations[at(finger.joints[i])] = turned * pose.rotations[at(finger.joints[i])];
      update_positions(finger, skeleton, pose);
    }
  };
  for (int round = 0; round < 4; ++round) {
    Vector3f thumb_by = Vector3f::Zero();
    float sum = 0;
    for (std::size_t f = 1; f < fingers_.size(); ++f) {
      if (!tips_[f] || !fingers_[f].known()) continue;
      const Vector3f apart = position_of(tips_[f]->source, source) - position_of(tips_[0]->source, source);
      const float weight = smooth_fall(scale * apart.norm(), kPinched, kApart);
      if (weight <= 0) continue;
      const Vector3f goal = scale * (target_from_source * apart);
      const Vector3f missing = goal - (position_of(tips_[f]->own, pose) - position_of(tips_[0]->own, pose));
      turn(fingers_[f], tips_[f]->own, (1 - kThumbShare) * weight * missing);
      thumb_by -= weight * weight * kThumbShare * missing;
      sum += weight;
    }
    if (sum <= 0) return;
    turn(thumb, tips_[0]->own, thumb_by / std::max(sum, 1e-3f));
  }
  for (const CharacterFinger& finger : fingers_) {
    if (!finger.known()) continue;
    for (std::size_t i = 0; i < 3; ++i) limit(finger, i, skeleton, pose);
    update_positions(finger, skeleton, pose);
  }
}

}  // namespace signweave
