#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "signweave/motion/kinematics.h"
#include "signweave/motion/turn_between.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

/// The turn whose x axis is `main` and whose y axis is as near to `side` as a right angle to `main` lets it be. Where
/// `side` lies along `main`, any right angle.
Eigen::Quaternionf axes_along(const Eigen::Vector3f& main, const Eigen::Vector3f& side) noexcept;

/// How a body's parts lie in the joints that play them: for each part axes with an anatomical meaning, in the joint's
/// own space. Bodies of other bones and other rest poses agree in what they do where these axes agree in model space.
/// Told from the offsets alone, so it holds for every pose (docs/retargeting.md).
class RigAxes {
 public:
  RigAxes(const Skeleton& skeleton, const RigMap& rig);

  /// joint_from_part: turns the part's axes into the joint's. The identity where the part is not known.
  const Eigen::Quaternionf& operator[](Part part) const noexcept { return axes_[static_cast<std::size_t>(part)]; }
  /// The whole trunk's axes at rest: x up, y to the signer's left, so z is back.
  const Eigen::Quaternionf& trunk() const noexcept { return trunk_; }
  /// Whether the collar bone leaves the trunk sideways at rest, as on a body. Where it does not, its own axes count,
  /// else the trunk's.
  bool collar_is_lateral(Side side) const noexcept { return lateral_[static_cast<std::size_t>(side)]; }
  /// Where the joints are while every rotation is the identity, metres.
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

/// From the left hip over the knee to the ankle, metres; 0 where any is missing. Right and left are meant to be alike.
float leg_length(const RigAxes& axes, const RigMap& rig);

}  // namespace signweave
