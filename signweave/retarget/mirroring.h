#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/motion/kinematics.h"
#include "signweave/motion/motion.h"
#include "signweave/retarget/counterparts.h"
#include "signweave/retarget/recorded_body.h"

namespace signweave {

/// The translation of a joint in a mirror.
struct MirroredTranslation {
  std::size_t from = 0;  ///< index in the pose; of the joint itself: kept as captured
  bool mirrored = false;
  Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();  ///< as Counterpart::turn, of the parent
  /// Added after mirroring, metres: the difference between the two sides' bones, so that each side keeps its own.
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();
};

/// How a recording's motion is mirrored: left and right exchanged on the same skeleton, about the vertical plane
/// through the pelvis' mean position and the signer's mean forward direction (SignerSpace). Immutable: threads may
/// share it.
struct Mirroring {
  std::shared_ptr<const Skeleton> skeleton;
  std::vector<Counterpart> joints;                ///< [joint]
  std::vector<MirroredTranslation> translations;  ///< [translated joint]
  JointIndex carrier = 0;                         ///< joint that carries the body; those above it are kept as captured
  Eigen::Quaternionf half_turn = Eigen::Quaternionf::Identity();  ///< about the plane's normal: its reflection, negated
  Eigen::Vector3f place = Eigen::Vector3f::Zero();                ///< a point of the plane, metres
  std::vector<Notice> notices;
};

/// Measures the mirroring of a recording. Directions of bones and palms are exact mirror images; where the bones of
/// left and right have different lengths, each side keeps its own, and a notice states by how much wrists miss their
/// mirrored positions. Throws Error{bad_input} if the signer's left and right are unknown (no shoulders).
Mirroring mirroring_of(const RecordedBody& body);

/// Mirrors poses. Belongs to one thread; allocates nothing after construction.
class Mirrorer {
 public:
  /// The mirroring must outlive it.
  explicit Mirrorer(const Mirroring& mirroring);

  /// Both are poses of the skeleton and may not overlap. Continuous: the sign of a quaternion follows the signs of the
  /// captured ones. Non-finite values affect the joints that depend on them.
  void pose(PoseView captured, MutablePoseView out) noexcept;

 private:
  const Mirroring& mirroring_;
  ModelPose captured_;
  std::vector<Eigen::Quaternionf> turns_;  ///< [joint], mirrored model_from_joint
};

/// Returns the whole motion mirrored, with its tracks (mirrored_tracks).
Motion mirrored(const Motion& motion, const Mirroring& mirroring);

}  // namespace signweave
