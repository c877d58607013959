#include <algorithm>
#include <cmath>

#include "demo/arms.h"

namespace signweave::demo {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

// Seconds.
constexpr double kSettle = 0.04;    ///< after the begin of a hold the hand has stopped
constexpr double kStop = 0.10;      ///< before the begin of a hold in which the hand comes to rest
constexpr double kRelease = 0.25;   ///< after the end of a hold in which the hand is released
constexpr double kApproach = 0.18;  ///< before and after a touch in which the hand is drawn to what it touches

// Metres from the bones of a fingertip to what it touches.
constexpr float kToSkin = 0.009f;
constexpr float kToFinger = 0.017f;

double eased_in(double t) {
  const double u = std::clamp(t, 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

/// 1 from begin to end, smoothly 0 outside.
double weight_at(double frame, double begin, double end, double before, double after) {
  if (frame < begin) return eased_in(1 - (begin - frame) / before);
  return frame > end ? eased_in(1 - (frame - end) / after) : 1.0;
}

/// Between two local rotations of a forearm: flexion and twist separately, since an elbow bends about one axis.
Quaternionf between_elbows(const Quaternionf& from, const Quaternionf& to, float weight, Side side) {
  const auto flexion = [&](const Quaternionf& rotation) {
    const Vector3f along = rotation * Vector3f(sign_of(side), 0, 0);
    return std::atan2(along.z(), sign_of(side) * along.x());
  };
  const auto hinge = [&](float angle) { return turn(static_cast<double>(-sign_of(side) * angle), Vector3f::UnitY()); };
  const Quaternionf twist_from = hinge(flexion(from)).conjugate() * from;
  const Quaternionf twist_to = hinge(flexion(to)).conjugate() * to;
  const float angle = flexion(from) + weight * (flexion(to) - flexion(from));
  return (hinge(angle) * twist_from.slerp(weight, twist_to)).normalized();
}

/// Index of a fingertip in the points of a hand: the wrist, then for each finger three joints and the tip, each after
/// the middle of its bone.
std::size_t tip_in_points(int finger) {
  return static_cast<std::size_t>(finger + 1) * 2 * (kPhalanges + 1);
}

}  // namespace

std::vector<JointIndex> Arms::limb_joints(Side side) const {
  const SideJoints& joints = signer_.side(side);
  std::vector<JointIndex> all = {joints.shoulder, joints.arm, joints.fore_arm, joints.hand};
  for (const auto& finger : joints.fingers) all.insert(all.end(), finger.begin(), finger.end());
  return all;
}

void Arms::remember_still(const Limbs& limbs, std::int64_t frame) {
  for (const Side side : kSides) {
    for (const HandPlan::Stillness& still : plan_.still(side)) {
      if (std::llround(still.begin + kSettle * fps_) != frame) continue;
      std::vector<Quaternionf> rotations(signer_.skeleton->joint_count(), Quaternionf::Identity());
      write_limb(limbs[static_cast<std::size_t>(side)], side, {rotations, {}});
      std::vector<Quaternionf> kept;
      for (const JointIndex joint : limb_joints(side)) kept.push_back(rotations[static_cast<std::size_t>(joint)]);
      still_[static_cast<std::size_t>(side)].push_back(std::move(kept));
    }
  }
}

void Arms::keep_still(std::int64_t frame, Side side, MutablePoseView pose) const {
  const auto at = static_cast<double>(frame);
  const auto which = static_cast<std::size_t>(side);
  for (std::size_t i = 0; i < plan_.still(side).size(); ++i) {
    const HandPlan::Stillness& still = plan_.still(side)[i];
    const double weight = weight_at(at, still.begin, still.end, kStop * fps_, kRelease * fps_);
    if (weight <= 0) continue;
    const std::vector<JointIndex> joints = limb_joints(side);
    for (std::size_t k = 0; k < joints.size(); ++k) {
      Quaternionf& rotation = pose.rotations[static_cast<std::size_t>(joints[k])];
      const bool elbow = joints[k] == signer_.side(side).fore_arm;
      rotation = elbow ? between_elbows(rotation, still_[which][i][k], static_cast<float>(weight), side)
                       : rotation.slerp(static_cast<float>(weight), still_[which][i][k]).normalized();
    }
    add_unrest(side, weight, static_cast<double>(frame) / fps_, pose);
  }
}

/// A signer's own unrest: about half a millimetre at the hand, in every joint.
void Arms::add_unrest(Side side, double weight, double seconds, MutablePoseView pose) const {
  const ArmIdleMotion& idle_motion = idle_motion_[static_cast<std::size_t>(side)];
  const double scale = weight * static_cast<double>(plan_.unrest());
  const auto add = [&](JointIndex joint, double radians, const Wander& wander, const Vector3f& axis) {
    Quaternionf& rotation = pose.rotations[static_cast<std::size_t>(joint)];
    rotation = (rotation * turn(scale * radians * wander.at(seconds), axis)).normalized();
  };
  const SideJoints& joints = signer_.side(side);
  add(joints.shoulder, 0.0004, idle_motion.place[0], Vector3f::UnitZ());
  add(joints.arm, 0.0006, idle_motion.place[1], Vector3f::UnitY());
  add(joints.arm, 0.0006, idle_motion.place[2], Vector3f::UnitZ());
  add(joints.fore_arm, 0.0010, idle_motion.twist, Vector3f::UnitX());
  add(joints.hand, 0.0010, idle_motion.flexion, Vector3f::UnitZ());
  for (std::size_t finger = 0; finger < kFingers; ++finger) {
    for (const JointIndex joint : joints.fingers[finger]) {
      add(joint, 0.0020, idle_motion.fingers[finger], Vector3f::UnitZ());
    }
  }
}

Vector3f Arms::touched_place(const HandPlan::Touch& touch, const Vector3f& tip, const Trunk& trunk,
                             PoseView pose) const {
  const auto place = [&](JointIndex joint) { return trunk.model.positions[static_cast<std::size_t>(joint)]; };
  const auto rotation = [&](JointIndex joint) { return trunk.model.rotations[static_cast<std::size_t>(joint)]; };
  if (touch.what == HandPlan::Touchable::chin) {
    const Skeleton& skeleton = *signer_.skeleton;
    const Quaternionf jaw = pose.rotations[static_cast<std::size_t>(signer_.jaw)];
    const Vector3f chin = skeleton.joint(signer_.jaw).offset + jaw * kChinFromJaw;
    return place(signer_.head) + rotation(signer_.head) * (chin + kToSkin * Vector3f(0, -0.3f, 1).normalized());
  }
  if (touch.what == HandPlan::Touchable::chest) {
    return place(signer_.spine2) + rotation(signer_.spine2) * (kChestFromSpine2 + Vector3f(0, 0, kToSkin));
  }
  if (touch.what == HandPlan::Touchable::mouth) {
    return place(signer_.head) + rotation(signer_.head) * (kMouthFromHead + Vector3f(0, 0, kToSkin));
  }
  const Side other = touch.side == Side::left ? Side::right : Side::left;
  const auto finger = static_cast<std::size_t>(touch.other_finger);
  const auto joint = static_cast<std::size_t>(signer_.side(other).fingers[finger].back());
  const ModelPose whole = to_model_space(*signer_.skeleton, pose);
  Vector3f end = signer_.finger_tip(finger);
  end.x() *= sign_of(other);
  const Vector3f touched = whole.positions[joint] + whole.rotations[joint] * end;
  return touched + kToFinger * (tip - touched).normalized();
}

void Arms::touch(Limb& limb, std::int64_t frame, Side side, const Trunk& trunk, PoseView pose) const {
  for (const HandPlan::Touch& touch : plan_.touches()) {
    if (touch.side != side) continue;
    const double weight =
        weight_at(static_cast<double>(frame), touch.begin, touch.end, kApproach * fps_, kApproach * fps_);
    if (weight <= 0) continue;
    const Vector3f planned = limb.points[tip_in_points(touch.finger)];
    const Vector3f wanted =
        planned + static_cast<float>(weight) * (touched_place(touch, planned, trunk, pose) - planned);
    for (int round = 0; round < 24; ++round) {  // the hand turns slightly with the arm
      Vector3f shift = wanted - limb.points[tip_in_points(touch.finger)];
      if (side == Side::right) shift.x() = -shift.x();
      limb.wrist += shift;
      pose_limb(limb, side, trunk);
    }
  }
}

}  // namespace signweave::demo
