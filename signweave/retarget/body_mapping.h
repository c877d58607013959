#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/motion/blend.h"
#include "signweave/retarget/recorded_body.h"
#include "signweave/retarget/retarget.h"

namespace signweave {

/// How the motion of one recording is put onto the skeleton of another. Immutable: threads may share it.
struct BodyMapping {
  Skeleton source;     ///< with its usual bones
  SignerModel signer;  ///< the source's
  Character character;
  RetargetOptions options;
  std::shared_ptr<const Skeleton> skeleton;  ///< the target's, as it is stored
  Pose usual;                                ///< how the target's signer mostly stands
  JointIndex carrier = 0;                    ///< the joint that carries the body: the root, or one below it that moves
  GroundTransform ground;       ///< to where the target's signer stands, where the root tells nothing of it
  float lift = 0;               ///< metres: to the target's floor
  std::vector<Notice> notices;  ///< what drives what, and what is approximate: a line each
};

/// Maps a recording's body to another's by their rig maps. Throws Error{bad_input} naming both recordings and the parts
/// where that is not safe, see match_bodies.
BodyMapping map_body(const RecordedBody& source, const RecordedBody& target);

/// Puts poses onto the target's skeleton. Belongs to one thread; after construction nothing is allocated.
class BodyMapper {
 public:
  /// The mapping must outlive it.
  explicit BodyMapper(const BodyMapping& mapping);
  BodyMapper(const BodyMapper&) = delete;
  BodyMapper& operator=(const BodyMapper&) = delete;

  /// `source` is a pose of the source's skeleton, `out` of the target's. Numbers that are none give the usual pose.
  void pose(PoseView source, MutablePoseView out) noexcept;
  const Retargeter& retargeter() const noexcept { return retargeter_; }

 private:
  const BodyMapping& mapping_;
  Retargeter retargeter_;
  Pose whole_;                                                      ///< of the character
  std::optional<std::size_t> root_translation_;                     ///< of a pose: the root's
  std::optional<std::size_t> carrier_translation_;                  ///< the carrier's; none where the root carries
  std::vector<JointIndex> above_;                                   ///< from the root to the carrier's parent
  Eigen::Quaternionf above_turn_ = Eigen::Quaternionf::Identity();  ///< of that parent as it mostly stands, model space
  Eigen::Vector3f above_place_ = Eigen::Vector3f::Zero();           ///< the same, metres
};

}  // namespace signweave
