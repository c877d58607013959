#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "signweave/motion/kinematics.h"
#include "signweave/motion/turn_between.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

/// Returns the rotation whose x axis is `main` and whose y axis is the component of `side` perpendicular to it. If
/// `side` is parallel to `main`, y is any perpendicular axis.
Eigen::Quaternionf axes_along(const Eigen::Vector3f& main, const Eigen::Vector3f& side) noexcept;

/// For each part of a body, axes with an anatomical meaning in the space of its joint. Bodies with different bones and
/// rest poses have the same posture if these axes agree in model space. Derived from the offsets alone, so valid for
/// every pose (docs/retargeting.md).
class RigAxes {
 public:
  RigAxes(const Skeleton& skeleton, const RigMap& rig);

  /// joint_from_part: rotates the part's axes into the joint's. The identity if the part is unknown.
  const Eigen::Quaternionf& operator[](Part part) const noexcept { return axes_[static_cast<std::size_t>(part)]; }
  /// The trunk's axes at rest: x up, y to the signer's left, so z is back.
  const Eigen::Quaternionf& trunk() const noexcept { return trunk_; }
  /// Returns whether the clavicle points sideways from the trunk at rest, as in a real body. If so, the trunk's axes
  /// are used for it, else its own.
  bool collar_is_lateral(Side side) const noexcept { return lateral_[static_cast<std::size_t>(side)]; }
  /// The positions of the joints if every rotation is the identity, metres.
  const std::vector<Eigen::Vector3f>& places() const noexcept { return rest_.positions; }
  Eigen::Vector3f place(Part part) const { return position_of((*rig_)[part], rest_); }

 private:
  Eigen::Quaternionf& at(Part part) { return axes_[static_cast<std::size_t>(part)]; }
  void take_trunk();
  void take_leg(Side side);
  void take_arm(Side side);
  void take_fingers(Side side, const Eigen::Vector3f& palm, const Eigen::Vector3f& thumb_side);

  const RigMap* rig_;
  ModelPose rest_;
  Eigen::Quaternionf trunk_ = Eigen::Quaternionf::Identity();
  std::array<Eigen::Quaternionf, kPartCount> axes_;
  std::array<bool, 2> lateral_ = {true, true};
};

/// Returns the length of the left leg from hip over knee to ankle, metres; 0 if any is missing. Right and left are
/// assumed to be equal.
float leg_length(const RigAxes& axes, const RigMap& rig);

}  // namespace signweave
