#pragma once

// For tests: a person whose wrists are at given places, and the same arms on another trunk.

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "signweave/features/phase_features.h"
#include "signweave/render/place_correction.h"
#include "signweave/rig/test_rig.h"

namespace signweave::testing_person {

inline Eigen::Quaternionf turn(float degrees, const Eigen::Vector3f& axis) {
  return Eigen::Quaternionf(Eigen::AngleAxisf(degrees * std::numbers::pi_v<float> / 180, axis.normalized()));
}

inline std::size_t slot(const Skeleton& skeleton, const std::string& name) {
  return static_cast<std::size_t>(skeleton.find(name).value());
}

/// The map, body and joints of the person.
struct Person {
  std::shared_ptr<const Skeleton> skeleton = whole_person();
  SignerModel signer;
  JointGroups groups;

  Person() {
    signer.rig = rig_of_signer(*skeleton);
    signer.body = signer_body(Motion(skeleton, {100, 1}, 1), signer.rig);
    groups = joint_groups(*skeleton, signer.rig);
  }
  ArmJoints arm(Side side) const {
    const std::string name = side == Side::left ? "Left" : "Right";
    return {*skeleton->find(name + "Arm"), *skeleton->find(name + "ForeArm"), *skeleton->find(name + "Hand")};
  }

  /// Bends an arm in front of the body and puts its wrist at a place (model space of an upright trunk, metres).
  void put_wrist(Side side, const Eigen::Vector3f& place, MutablePoseView pose) const {
    const ArmJoints joints = arm(side);
    const float s = side == Side::left ? 1.0f : -1.0f;
    pose.rotations[static_cast<std::size_t>(joints.shoulder)] = turn(-70 * s, Eigen::Vector3f::UnitZ());
    pose.rotations[static_cast<std::size_t>(joints.elbow)] = turn(-95 * s, {0, 1, 0.1f});
    pose.rotations[static_cast<std::size_t>(joints.wrist)] = turn(12, {0.3f, 1, 0.5f});
    for (int i = 0; i < 4; ++i) {
      const ModelPose model = to_model_space(*skeleton, pose);
      shift_wrist(*skeleton, joints, model, place - model.positions[static_cast<std::size_t>(joints.wrist)], pose);
    }
  }

  using WristAt = std::function<Eigen::Vector3f(Side, float)>;
  /// A stroke of some frames, with wrists as functions of the time from 0 to 1 fingers that bend, and a
  /// right shoulder that rises.
  Motion stroke(const WristAt& wrist, std::int64_t frames = 20, bool shrugs = true) const {
    Motion motion(skeleton, {100, 1}, frames);
    for (std::int64_t frame = 0; frame < frames; ++frame) {
      const float t = static_cast<float>(frame) / static_cast<float>(std::max<std::int64_t>(frames - 1, 1));
      const MutablePoseView pose = motion.pose(frame);
      for (const Side side : kSides) {
        put_wrist(side, wrist(side, t), pose);
        for (const JointIndex finger : groups[fingers_of(side)]) {
          pose.rotations[static_cast<std::size_t>(finger)] =
              turn(20 * std::sin(3 * t + static_cast<float>(finger)), Eigen::Vector3f::UnitZ());
        }
      }
      if (shrugs) pose.rotations[slot(*skeleton, "RightShoulder")] = turn(4 * t, Eigen::Vector3f::UnitZ());
    }
    keep_hemisphere(motion);
    return motion;
  }

  PosesView all_of(const Motion& motion) const { return view_of(motion, {0, motion.frame_count()}); }
  ArmPlacer placer() const { return ArmPlacer(*skeleton, signer, groups); }
};

/// In front of the chest, moving sideways and up; both hands free.
inline Eigen::Vector3f in_front(Side side, float t) {
  const float s = side == Side::left ? 1.0f : -1.0f;
  return {s * (0.2f + 0.06f * t), 1.2f + 0.1f * t * t, 0.33f - 0.05f * t};
}
/// The right hand at the chin, moving forward; the left one free.
inline Eigen::Vector3f at_chin(Side side, float t) {
  return side == Side::left ? in_front(side, t) : Eigen::Vector3f(-0.07f, 1.5f - 0.03f * t, 0.085f + 0.08f * t);
}
/// Both hands on each other.
inline Eigen::Vector3f together(Side side, float t) {
  return {side == Side::left ? 0.02f : -0.02f, 1.2f + 0.05f * t, 0.3f};
}

using TrunkTurn = std::function<void(float t, MutablePoseView pose)>;
/// The same arms on another trunk: `trunk` changes root, trunk and head of each pose.
inline Motion on_other_trunk(Motion motion, const TrunkTurn& trunk) {
  const auto frames = static_cast<float>(motion.frame_count());
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    trunk(static_cast<float>(frame) / frames, motion.pose(frame));
  }
  return motion;
}

}  // namespace signweave::testing_person
