#pragma once

#include <Eigen/Geometry>

#include "signweave/motion/kinematics.h"
#include "signweave/motion/motion.h"

namespace signweave {

/// The bending joints of an arm, each an ancestor of the next; helper joints may lie between.
struct ArmJoints {
  JointIndex shoulder = kNoJoint;
  JointIndex elbow = kNoJoint;
  JointIndex wrist = kNoJoint;
};

/// Returns true if `upper` is an ancestor of `lower`.
bool is_above(const Skeleton& skeleton, JointIndex upper, JointIndex lower) noexcept;

/// Shifts the wrist of one pose by `by` metres in model space. Elbow and shoulder follow (two-bone inverse kinematics;
/// the elbow angle stays within 29° to 178° unless it is already outside), and the hand keeps its orientation. `model`
/// holds the pose's joints in model space; only the arm's joints and their ancestors are read, and `model` is not
/// updated.
void shift_wrist(const Skeleton& skeleton, const ArmJoints& arm, const ModelPose& model, const Eigen::Vector3f& by,
                 MutablePoseView pose) noexcept;

/// Rotates the arm by `by` radians about the line from shoulder to wrist. The elbow swings around it; the hand stays as
/// it is.
void swivel_elbow(const Skeleton& skeleton, const ArmJoints& arm, const ModelPose& model, float by,
                  MutablePoseView pose) noexcept;

/// Sets a joint's rotation, with the quaternion's sign chosen to lie in the hemisphere of the previous rotation.
void set_in_hemisphere(Eigen::Quaternionf& local, Eigen::Quaternionf to) noexcept;

}  // namespace signweave
