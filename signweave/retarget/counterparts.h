#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "signweave/motion/motion.h"
#include "signweave/retarget/rig_axes.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

/// The joint whose movement a joint shows in a mirror.
struct Counterpart {
  JointIndex joint = kNoJoint;  ///< of the other side; itself in the middle; kNoJoint: none
  /// joint_from_counterpart, without its reflection: v in the counterpart's space is seen in the mirror as -(turn * v)
  /// in the joint's. The counterpart has the inverse.
  Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();
};

/// What the rotation of a joint relative to its parent usually is.
struct UsualRotation {
  Eigen::Quaternionf mean = Eigen::Quaternionf::Identity();
  bool still = false;                              ///< it never leaves the mean by more than 2°
  Eigen::Vector3f left = Eigen::Vector3f::Zero();  ///< mean direction to the signer's left, joint's space, unit or zero
};
/// Returns [joint] for a motion of at least one frame, without `left`. Non-finite rotations are skipped.
std::vector<UsualRotation> usual_rotations(const Motion& motion);

/// Returns [joint] the counterpart of each joint that is `top` or below it; the others have none.
///
/// Joints with a part have that of the other side; joints without one are paired below counterparts, by names that
/// differ in the side, else by offsets that are mirror images. A joint that differs from all of them is in the middle
/// if its parent is, and else has no counterpart.
///
/// A joint's space in the mirror follows from the axes of its part (RigAxes), which depend on offsets alone, so the two
/// sides may have different rest spaces. Without axes it follows from the usual rotation of joints that are still, else
/// from the parent's. Bones to a pair of children that the axes miss by more than 25° show that the joint has a space
/// of its own, which then follows from these bones or from the usual rotation; of a joint in the middle without such
/// bones, so does a usual direction to the left that differs by more than 25° (neck and head: 50°).
std::vector<Counterpart> counterparts(const Skeleton& skeleton, const RigMap& rig, JointIndex top,
                                      const std::vector<UsualRotation>& usual);

}  // namespace signweave
