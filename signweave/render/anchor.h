#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string_view>

#include "signweave/features/hand_motion.h"
#include "signweave/motion/kinematics.h"
#include "signweave/score/hand_place.h"

namespace signweave {

/// Returns the anchor of a hand that touches all of these over a stroke: the other hand before the head, the head
/// before the trunk.
Anchor anchor_of(Contact touched) noexcept;

/// A rotation about the origin, then a shift.
struct RigidMotion {
  Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();  ///< metres

  Eigen::Vector3f operator*(const Eigen::Vector3f& point) const { return turn * point + shift; }
};

/// The same place relative to an anchor in two poses.
struct AnchorMotion {
  RigidMotion target_from_source;                                   ///< model space
  Eigen::Quaternionf target_turn = Eigen::Quaternionf::Identity();  ///< model from the anchor's axes, in the target
};

/// The spaces to which a hand is anchored, in poses of one body.
class AnchorSpaces {
 public:
  AnchorSpaces() = default;
  /// `signer` must have a body, and must outlive this.
  explicit AnchorSpaces(const SignerModel& signer);

  /// Returns the motion that takes a place in the `source` pose to the same place in the `target` pose:
  /// relative to the head, to the trunk (the joint from which both arms grow), or in signer-centred space. The poses
  /// must hold head, trunk and both shoulders; a body without head has its trunk in its stead.
  ///
  /// Signer-centred space depends on both shoulders, which move with the arms. That of the target is therefore the one
  /// that its trunk has with the source's shoulders: a hand does not rise because the other shoulder, which comes from
  /// elsewhere, shrugs. If both arms come from the source, it is the target's own. Precondition: not other_hand.
  AnchorMotion between(Anchor anchor, const ModelPose& source, const ModelPose& target);

  /// The signer-centred space of a target with the source's shoulders, as above.
  SignerSpace space_with_shoulders_of(const ModelPose& source, const ModelPose& target);

 private:
  const SignerModel* signer_ = nullptr;
  ModelPose carried_;  ///< the target's trunk and the source's shoulders on it
};

}  // namespace signweave
