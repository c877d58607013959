#pragma once

#include <array>
#include <memory>

#include "signweave/motion/skeleton.h"

namespace signweave::demo {

/// Side of the body. The signer faces +Z, so the left side is +X.
enum class Side { left, right };
inline constexpr std::array kSides = {Side::left, Side::right};
/// +1 for the left, −1 for the right: the sign of x on that side.
constexpr float sign_of(Side side) noexcept {
  return side == Side::left ? 1.0f : -1.0f;
}

inline constexpr int kFingers = 5;    ///< thumb, index, middle, ring, pinky
inline constexpr int kPhalanges = 3;  ///< from the palm outwards

/// The joints of one side.
struct SideJoints {
  JointIndex shoulder;  ///< the clavicle
  JointIndex arm;
  JointIndex fore_arm;
  JointIndex hand;  ///< the wrist
  std::array<std::array<JointIndex, kPhalanges>, kFingers> fingers;
  JointIndex up_leg;
  JointIndex leg;
  JointIndex foot;
  JointIndex toe;
  JointIndex eye;
};

/// The synthetic signer's body: 56 joints of a person of 1.70 m in metres, standing at the origin, facing +Z. When
/// every rotation is the identity it is in a T-pose with the palms down. Names are those of common character rigs
/// (Hips, LeftForeArm, LeftHandThumb1, …).
struct Signer {
  std::shared_ptr<const Skeleton> skeleton;
  JointIndex hips, spine, spine1, spine2, neck, neck1, head, jaw;
  SideJoints left, right;

  const SideJoints& side(Side which) const noexcept { return which == Side::left ? left : right; }
  /// From a finger's last joint to its tip, left hand, metres.
  Eigen::Vector3f finger_tip(std::size_t finger) const;
  /// Position of a joint in the rest pose, metres, model space.
  Eigen::Vector3f rest_position(JointIndex joint) const;
};

Signer make_signer();

}  // namespace signweave::demo
