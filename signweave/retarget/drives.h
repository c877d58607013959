#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "signweave/motion/kinematics.h"
#include "signweave/retarget/character.h"
#include "signweave/retarget/rig_axes.h"

namespace signweave {

/// The source of one character joint's rotation: interpolated between two joints of the source.
struct Drive {
  JointIndex first = kNoJoint;   ///< joint of the source; kNoJoint: the joint follows its parent
  JointIndex second = kNoJoint;  ///< equal to `first` if a single joint drives it
  float share = 0;               ///< weight of `second`, in [0, 1]
  Eigen::Quaternionf from_first =
      Eigen::Quaternionf::Identity();  ///< first_from_joint: rotates the joint's axes into first's
  Eigen::Quaternionf from_second = Eigen::Quaternionf::Identity();

  bool driven() const noexcept { return first != kNoJoint; }
  /// Returns model_from_joint of a driven joint.
  Eigen::Quaternionf turn(const ModelPose& source) const noexcept {
    Eigen::Quaternionf a = source.rotations[static_cast<std::size_t>(first)] * from_first;
    if (second == first) return a;
    return a.slerp(share, source.rotations[static_cast<std::size_t>(second)] * from_second);
  }
};

/// Returns the joints from `upper` to its descendant `lower`, inclusive; empty if it is not a descendant.
std::vector<JointIndex> path_between(const Skeleton& skeleton, JointIndex upper, JointIndex lower);

/// How a source's joints drive a character's: part by part, and along spine, neck and limbs by the relative position on
/// the chain, so that five bones share what two did.
struct Drives {
  std::vector<Drive> joints;          ///< [the character's joint]
  std::array<bool, 2> upper_twist{};  ///< [Side] the source's upper arm has extra joints that carry its twist
  std::array<bool, 2> lower_twist{};  ///< the same for the forearm
  std::array<bool, 2> collar{};       ///< [Side] the source has a clavicle
  std::vector<std::string> missing;   ///< one line for each part that stays at rest
};
Drives drives_of(const Skeleton& source, const RigMap& source_rig, const RigAxes& source_axes,
                 const Character& character, const RigAxes& axes);

}  // namespace signweave
