#pragma once

#include <Eigen/Geometry>

namespace signweave::demo {

// Everything here is told of the left arm: x to the signer's left, y up, z forward. The right arm is its mirror image.

/// A turn about a unit axis; radians.
inline Eigen::Quaternionf turn(double angle, const Eigen::Vector3f& axis) {
  return Eigen::Quaternionf(Eigen::AngleAxisf(static_cast<float>(angle), axis));
}

/// Two bones of fixed lengths from a joint to a target.
struct TwoBones {
  Eigen::Vector3f middle;  ///< the elbow or knee, metres
  Eigen::Vector3f end;     ///< the target, or the nearest point that the bones reach
  Eigen::Vector3f hinge;   ///< unit; upper bone × lower bone: the axis about which the middle joint bends
};
/// `toward` is where the middle joint should point; it must not lie along the line from joint to target.
TwoBones solve_two_bones(const Eigen::Vector3f& start, const Eigen::Vector3f& target, float upper, float lower,
                         const Eigen::Vector3f& toward);

/// What the wrist does, in the angles that joints have limits for. Radians.
struct WristAngles {
  float twist = 0;  ///< of the forearm: with the elbow at the side 0 turns the thumb up, −π/2 the palm up, π/2 down
  float flexion = 0;  ///< towards the palm
  float radial = 0;   ///< towards the thumb
  float swivel = 0;   ///< of the elbow about the line shoulder–wrist: outwards and up
};

struct ArmSizes {
  float upper, lower;  ///< metres
};

/// Rotations of one arm in model space.
struct ArmPose {
  Eigen::Quaternionf arm, fore_arm, hand;
  Eigen::Vector3f elbow, wrist;
};
/// The arm whose wrist is at a target.
ArmPose solve_arm(const Eigen::Vector3f& shoulder, const Eigen::Vector3f& wrist, ArmSizes sizes,
                  const WristAngles& angles);

inline constexpr float kNaturalSwivel = 0.2f;  ///< radians: the elbow a little away from the body

/// The nearest angles that joints allow: forearm 90° to palm up and 85° to palm down, wrist 70° of flexion and of
/// extension, 25° to the thumb, 40° from it.
WristAngles limited(WristAngles angles);

/// The angles that turn the palm and the fingers as near to two directions as joints allow, with the elbow as near to
/// `swivel` as is comfortable.
WristAngles comfortable_wrist(const Eigen::Vector3f& shoulder, const Eigen::Vector3f& wrist, ArmSizes sizes,
                              const Eigen::Vector3f& palm, const Eigen::Vector3f& fingers,
                              float swivel = kNaturalSwivel);

/// How the clavicle follows a wrist target (relative to the shoulder joint in the rest pose).
Eigen::Quaternionf clavicle_rotation(const Eigen::Vector3f& shoulder_to_wrist);

}  // namespace signweave::demo
