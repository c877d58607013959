#pragma once

#include <Eigen/Geometry>

namespace signweave::demo {

// Everything here describes the left arm: x to the signer's left, y up, z forward. The right arm is its mirror image.

/// A rotation about a unit axis; radians.
inline Eigen::Quaternionf turn(double angle, const Eigen::Vector3f& axis) {
  return Eigen::Quaternionf(Eigen::AngleAxisf(static_cast<float>(angle), axis));
}

/// Two bones of fixed lengths from a joint to a target.
struct TwoBones {
  Eigen::Vector3f middle;  ///< the elbow or knee, metres
  Eigen::Vector3f end;     ///< the target, or the nearest point the bones reach
  Eigen::Vector3f hinge;   ///< unit; upper bone × lower bone: the axis about which the middle joint bends
};
/// `toward` is the position the middle joint should point to; it must not lie on the line from joint to target.
TwoBones solve_two_bones(const Eigen::Vector3f& start, const Eigen::Vector3f& target, float upper, float lower,
                         const Eigen::Vector3f& toward);

/// The wrist in the angles that have joint limits. Radians.
struct WristAngles {
  float twist = 0;    ///< of the forearm; elbow at the side: 0 is thumb up, −π/2 palm up, π/2 palm down
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

inline constexpr float kNaturalSwivel = 0.2f;  ///< radians: the elbow slightly away from the body

/// The twist, flexion and radial deviation that bring a hand at a forearm without twist (solve_arm with `twist` 0) to
/// `fore_arm` * `turn`; `swivel` is 0. Not limited.
WristAngles wrist_angles(const Eigen::Quaternionf& turn);

/// The nearest angles within joint limits: forearm 90° to palm up and 85° to palm down, wrist 70° of flexion and of
/// extension, 25° to the thumb, 40° away from it.
WristAngles limited(WristAngles angles);

/// The angles that bring palm and fingers as close to two directions as the joint limits allow, with the elbow as close
/// to `swivel` as is comfortable.
WristAngles comfortable_wrist(const Eigen::Vector3f& shoulder, const Eigen::Vector3f& wrist, ArmSizes sizes,
                              const Eigen::Vector3f& palm, const Eigen::Vector3f& fingers,
                              float swivel = kNaturalSwivel);

/// Rotation of the clavicle as it follows a wrist target (relative to the shoulder joint in the rest pose).
Eigen::Quaternionf clavicle_rotation(const Eigen::Vector3f& shoulder_to_wrist);

}  // namespace signweave::demo
