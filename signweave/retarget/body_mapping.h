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

/// The mapping of one recording's motion onto the skeleton of another. Immutable: threads may share it.
struct BodyMapping {
  Skeleton source;     ///< with its usual bone lengths
  SignerModel signer;  ///< the source's
  Character character;
  RetargetOptions options;
  std::shared_ptr<const Skeleton> skeleton;  ///< the target's, as stored
  Pose usual;                                ///< the usual pose of the target's signer
  JointIndex carrier = 0;                    ///< joint that carries the body: the root, or a moving joint below it
  GroundTransform ground;       ///< to the position of the target's signer, if the root does not determine it
  float lift = 0;               ///< to the target's floor, metres
  std::vector<Notice> notices;  ///< one line each: which joints are driven, and what is approximate
};

/// Maps a recording's body to another's by their rig maps. Throws Error{bad_input}, naming both recordings and the
/// parts, if this is not safe; see match_bodies.
BodyMapping map_body(const RecordedBody& source, const RecordedBody& target);

/// Retargets poses to the target's skeleton. Belongs to one thread; allocates nothing after construction.
class BodyMapper {
 public:
  /// The mapping must outlive it.
  explicit BodyMapper(const BodyMapping& mapping);
  BodyMapper(const BodyMapper&) = delete;
  BodyMapper& operator=(const BodyMapper&) = delete;

  /// `source` is a pose of the source's skeleton, `out` of the target's. Non-finite input gives the usual pose.
  void pose(PoseView source, MutablePoseView out) noexcept;
  const Retargeter& retargeter() const noexcept { return retargeter_; }

 private:
  const BodyMapping& mapping_;
  Retargeter retargeter_;
  Pose whole_;                                      ///< pose of the character
  std::optional<std::size_t> root_translation_;     ///< index of the root's translation in a pose
  std::optional<std::size_t> carrier_translation_;  ///< index of the carrier's; nullopt if the root is the carrier
  std::vector<JointIndex> above_;                   ///< from the root to the carrier's parent
  Eigen::Quaternionf above_turn_ =
      Eigen::Quaternionf::Identity();                      ///< rotation of that parent in the usual pose, model space
  Eigen::Vector3f above_place_ = Eigen::Vector3f::Zero();  ///< its position, metres
};

}  // namespace signweave
