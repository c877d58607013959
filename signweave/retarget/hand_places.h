#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "signweave/motion/kinematics.h"
#include "signweave/retarget/body_surface.h"
#include "signweave/retarget/fingers.h"
#include "signweave/rig/rig_map.h"
#include "signweave/rig/signer_space.h"

namespace signweave {

/// A body in hand placement: the source's, or the character's.
struct PlacedBody {
  const RigMap* rig = nullptr;
  const ModelPose* pose = nullptr;
  const SignerBody* body = nullptr;
  SignerSpace space;
};

/// The head's space: the midpoint between the eyes and the head's axes.
struct HeadSpace {
  Eigen::Vector3f eyes = Eigen::Vector3f::Zero();            ///< metres, model space
  Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();  ///< model_from_head; x up, y to the signer's left
  float size = 1;                                            ///< metres, chin to top
};

/// The same hand of both bodies. The character's points are relative to its wrist, whose position is still to be
/// determined.
struct TwoHands {
  const CharacterFingers* fingers = nullptr;
  JointIndex source_wrist = kNoJoint;
  JointIndex wrist = kNoJoint;
};

/// Target positions of the character's wrists at which its hands match the source's: in signer-centred space; near the
/// face relative to the face's size; if the hands are near each other, with the same relative position; and never
/// inside the body. `surface` must match the character's pose. Metres, model space. (ours)
struct WristGoals {
  std::array<std::optional<Eigen::Vector3f>, 2> wrists;  ///< [Side]
};
WristGoals wrist_goals(const PlacedBody& source, const std::optional<HeadSpace>& source_head, const PlacedBody& own,
                       const std::optional<HeadSpace>& own_head, const std::array<std::optional<TwoHands>, 2>& hands,
                       const BodySurface& surface, float unit_ratio) noexcept;

/// Returns `goal` of a character's wrist (metres, model space), moved out along the surface if a point of the hand is
/// inside the body. `pose` is the character's.
Eigen::Vector3f out_of_body(const TwoHands& hand, const ModelPose& pose, const BodySurface& surface,
                            const Eigen::Vector3f& goal) noexcept;

}  // namespace signweave
