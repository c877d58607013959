#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "signweave/motion/kinematics.h"
#include "signweave/motion/motion.h"
#include "signweave/rig/rig_map.h"

/// What is drawn of a skeleton: its rig map as positions, widths and directions.
namespace signweave {

/// The head as an ellipsoid, in the plan's pose.
struct HeadShape {
  JointIndex joint = kNoJoint;
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();
  Eigen::Vector3f left = Eigen::Vector3f::UnitX();  ///< of the person; unit, as are the next two
  Eigen::Vector3f up = Eigen::Vector3f::UnitY();
  Eigen::Vector3f forward = Eigen::Vector3f::UnitZ();
  Eigen::Vector3f half = Eigen::Vector3f::Zero();  ///< metres along left, up, forward
};

/// A joint from which fingers grow.
struct HandShape {
  JointIndex joint = kNoJoint;
  std::vector<JointIndex> knuckles;  ///< where fingers leave the palm, below the joint; at least four
};

/// All values are in the model space of one captured pose, in metres, because the limbs of a rest pose may point
/// anywhere.
struct BodyPlan {
  ModelPose pose;
  std::vector<Eigen::Vector3f> bones;      ///< [joint] from its parent to it; zero for the root
  std::vector<Eigen::Vector3f> tip_bones;  ///< [tip] from its joint to it
  std::vector<std::vector<JointIndex>> children;
  float size = 1;                                   ///< approximately the stature, from the bone lengths; above 0
  Eigen::Vector3f left = Eigen::Vector3f::UnitX();  ///< unit, of the trunk
  Eigen::Vector3f up = Eigen::Vector3f::UnitY();
  Eigen::Vector3f forward = Eigen::Vector3f::UnitZ();
  std::vector<JointIndex> trunk;      ///< from the pelvis to the chest; empty if the map lacks trunk, arm or head
  JointIndex neck = kNoJoint;         ///< child of the chest that leads to the head
  std::vector<JointIndex> shoulders;  ///< where the two arms begin, left first
  std::vector<JointIndex> collars;    ///< between the chest and the shoulders
  float hip_width = 0;                ///< half the distance between the legs
  float shoulder_width = 0;           ///< half the distance between the arms
  std::optional<HeadShape> head;
  std::vector<HandShape> hands;

  const Eigen::Vector3f& place(JointIndex joint) const { return pose.positions[static_cast<std::size_t>(joint)]; }
};

/// The plan of a motion of at least one frame, taken from its middle frame. `rig` must be a map of its skeleton.
BodyPlan plan_of(const Motion& motion, const RigMap& rig);
/// The same with the map that joint names and body shape give.
inline BodyPlan plan_of(const Motion& motion) {
  return plan_of(motion, map_rig(motion));
}

}  // namespace signweave
