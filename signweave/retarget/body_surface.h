#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "signweave/motion/kinematics.h"
#include "signweave/retarget/character.h"
#include "signweave/retarget/rig_axes.h"

namespace signweave {

/// Roughly where a character's clothes and face are, so that hands stay outside: the trunk down to the thighs as
/// sections that round off to the sides, the head as one such body. Told from height, shoulders and eyes alone, with
/// the proportions of the characters of studio/avatar. Of a character without height nothing is known. (ours)
class BodySurface {
 public:
  BodySurface(const Character& character, const RigAxes& axes);

  /// Takes up where trunk and head are in a pose.
  void place(const ModelPose& pose) noexcept;

  /// The way out of the body for a ball whose middle is `point` (model space) and whose radius is `radius`, metres: the
  /// shortest one along the surface's normal; zero where it is outside.
  Eigen::Vector3f way_out(const Eigen::Vector3f& point, float radius) const noexcept;

  /// Scales lengths of a person of 1.67 m to this one.
  float scale() const noexcept { return scale_; }

 private:
  /// A space that moves with a joint: x to the signer's left, y up, z forward.
  struct Space {
    JointIndex joint = kNoJoint;
    Eigen::Vector3f origin = Eigen::Vector3f::Zero();          ///< at rest, in the joint's space, metres
    Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();  ///< joint_from_space
    Eigen::Vector3f origin_now = Eigen::Vector3f::Zero();      ///< model space
    Eigen::Quaternionf turn_now = Eigen::Quaternionf::Identity();
  };
  static Eigen::Vector3f trunk_way(const Eigen::Vector3f& point, float radius) noexcept;
  static Eigen::Vector3f head_way(const Eigen::Vector3f& point, float radius) noexcept;

  float scale_ = 1;
  std::optional<Space> chest_;   ///< with the pelvis, or neither
  std::optional<Space> pelvis_;  ///< its origin, too, is between the shoulders at rest
  std::optional<Space> head_;
};

}  // namespace signweave
