#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "signweave/motion/kinematics.h"
#include "signweave/retarget/character.h"
#include "signweave/retarget/rig_axes.h"

namespace signweave {

/// Where the turn of one of the character's joints comes from: between two of the source's.
struct Drive {
  JointIndex first = kNoJoint;   ///< of the source; kNoJoint: the joint goes with its parent
  JointIndex second = kNoJoint;  ///< the same as `first` where one joint tells all
  float share = 0;               ///< of `second`, in [0, 1]
  Eigen::Quaternionf from_first =
      Eigen::Quaternionf::Identity();  ///< first_from_joint: turns the joint's axes into first's
  Eigen::Quaternionf from_second = Eigen::Quaternionf::Identity();

  bool driven() const noexcept { return first != kNoJoint; }
  /// model_from_joint, of a driven joint.
  Eigen::Quaternionf turn(const ModelPose& source) const noexcept {
    Eigen::Quaternionf a = source.rotations[static_cast<std::size_t>(first)] * from_first;
    if (second == first) return a;
    return a.slerp(share, source.rotations[static_cast<std::size_t>(second)] * from_second);
  }
};

/// The joints from one to another below it, with both; empty where it is not below.
std::vector<JointIndex> path_between(const Skeleton& skeleton, JointIndex upper, JointIndex lower);

/// How a source's joints drive a character's: part for part, and along spine, neck and limbs by how far up the joints
/// lie, so that five bones share what two did.
struct Drives {
  std::vector<Drive> joints;          ///< [the character's joint]
  std::array<bool, 2> upper_twist{};  ///< [Side] the source's upper arm has joints of its own that carry its twist
  std::array<bool, 2> lower_twist{};  ///< the same of the forearm
  std::array<bool, 2> collar{};       ///< the source has a collar bone
  std::vector<std::string> missing;   ///< what stays at rest, a line each
};
Drives drives_of(const Skeleton& source, const RigMap& source_rig, const RigAxes& source_axes,
                 const Character& character, const RigAxes& axes);

}  // namespace signweave
