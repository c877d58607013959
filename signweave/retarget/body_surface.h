#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "signweave/motion/kinematics.h"
#include "signweave/retarget/character.h"
#include "signweave/retarget/rig_axes.h"

namespace signweave {

/// An approximate surface of a character's clothes and face that keeps hands outside: the trunk down to the thighs as
/// sections with rounded sides, the head as one rounded body. Derived from height, shoulders and eyes alone, with the
/// proportions of the characters of studio/avatar. A character without height has no surface. (ours)
class BodySurface {
 public:
  BodySurface(const Character& character, const RigAxes& axes);

  /// Moves the surface with trunk and head of a pose.
  void place(const ModelPose& pose) noexcept;

  /// Returns the displacement that moves a sphere with centre `point` (model space) and radius `radius`, metres, out of
  /// the body: the shortest one along the surface's normal; zero if the sphere is outside.
  Eigen::Vector3f push_out(const Eigen::Vector3f& point, float radius) const noexcept;

  /// Scale factor from a person of 1.67 m to this one.
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
  static Eigen::Vector3f push_out_of_trunk(const Eigen::Vector3f& point, float radius) noexcept;
  static Eigen::Vector3f push_out_of_head(const Eigen::Vector3f& point, float radius) noexcept;

  float scale_ = 1;
  std::optional<Space> chest_;   ///< present if and only if pelvis_ is
  std::optional<Space> pelvis_;  ///< its origin is also between the shoulders at rest
  std::optional<Space> head_;
};

}  // namespace signweave
