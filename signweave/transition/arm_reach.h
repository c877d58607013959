#pragma once

#include <Eigen/Geometry>

#include "signweave/motion/kinematics.h"
#include "signweave/motion/motion.h"

namespace signweave {

/// The joints by which an arm bends, each above the next; helpers may lie between.
struct ArmJoints {
  JointIndex shoulder = kNoJoint;
  JointIndex elbow = kNoJoint;
  JointIndex wrist = kNoJoint;
};

/// Whether a joint is above another in the hierarchy.
bool is_above(const Skeleton& skeleton, JointIndex upper, JointIndex lower) noexcept;

/// Shifts the wrist of one pose by metres in model space: elbow and shoulder follow (two-bone inverse kinematics, the
/// elbow never past 29° nor 178° but where it is already), the hand keeps its orientation. `model` is where the pose's
/// joints are, of which the arm's and all above are looked at; it is not brought up to date.
void shift_wrist(const Skeleton& skeleton, const ArmJoints& arm, const ModelPose& model, const Eigen::Vector3f& by,
                 MutablePoseView pose) noexcept;

/// Turns the arm by radians about the line from shoulder to wrist: the elbow goes round it, the hand stays as it is.
void swivel_elbow(const Skeleton& skeleton, const ArmJoints& arm, const ModelPose& model, float by,
                  MutablePoseView pose) noexcept;

/// Gives a joint another rotation, of the two signs the one in the hemisphere of what it had.
void set_in_hemisphere(Eigen::Quaternionf& local, Eigen::Quaternionf to) noexcept;

}  // namespace signweave
