#pragma once

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/motion/skeleton.h"
#include "signweave/rig/rig_map.h"
#include "signweave/rig/signer_space.h"

namespace signweave {

/// The range of angles of a joint, radians.
struct AngleLimits {
  float least = 0;
  float greatest = 0;
  friend bool operator==(AngleLimits, AngleLimits) = default;
};

/// A finger of a character. Vectors are unit vectors in model space at rest; flexion is measured from the straight
/// finger, but for the thumb's first joint from rest.
struct CharacterFinger {
  std::array<JointIndex, 3> joints = {kNoJoint, kNoJoint,
                                      kNoJoint};            ///< from the knuckle; for the thumb, from the wrist
  JointIndex metacarpal = kNoJoint;                         ///< inside the palm; kNoJoint if there is none
  Eigen::Vector3f flexion_axis = Eigen::Vector3f::UnitX();  ///< a positive rotation about it flexes each joint
  Eigen::Vector3f spread_axis = Eigen::Vector3f::UnitY();   ///< of the first joint, positive to the thumb's side
  std::array<float, 3> rest_flexion = {0, 0, 0};            ///< radians
  std::array<AngleLimits, 3> flexion;
  AngleLimits spread;
  float slack = 0.35f;  ///< maximum rotation other than flexion and spread, radians

  bool known() const noexcept { return joints[0] != kNoJoint; }
};

/// A hand of a character.
struct CharacterHand {
  std::vector<JointIndex> twist;     ///< of the forearm, nearest to the hand first: they share the hand's twist
  std::vector<JointIndex> shoulder;  ///< from the clavicle to the arm's last joint before the elbow
  float length = 0;                  ///< from the wrist to the middle fingertip, metres; above 0
  std::array<CharacterFinger, kFingers.size()> fingers;  ///< [Finger]
};

/// A body that motions are retargeted to. At rest every joint's rotation is the identity, so a joint's own axes are
/// those of model space. Plain data: the creator must keep joint indices within the skeleton.
struct Character {
  std::string name;
  std::shared_ptr<const Skeleton> skeleton;  ///< the root is the only translated joint
  RigMap rig;
  std::optional<SignerBody> body;                  ///< at rest; nullopt if a shoulder is missing
  std::array<CharacterHand, 2> hands;              ///< [Side]
  Eigen::Vector3f eyes = Eigen::Vector3f::Zero();  ///< midpoint between them at rest, metres, model space
  float height = 0;                                ///< top of the head, metres; 0: surface unknown
  std::vector<std::string> face_units;             ///< names of its morph targets, ascending
  /// [joint] rotations of undriven joints relative to their parents; empty: identity.
  std::vector<Eigen::Quaternionf> still;

  Eigen::Quaternionf still_turn(std::size_t joint) const noexcept {
    return still.empty() ? Eigen::Quaternionf::Identity() : still[joint];
  }
  const CharacterHand& hand(Side side) const noexcept { return hands[static_cast<std::size_t>(side)]; }
};

/// Reads a GLB file as written by studio/avatar/build, plain or compressed: nodes, the skin's joints, and
/// asset.extras.signweave. Meshes and images are ignored. Throws Error{bad_input, "FILE: …"} if anything is missing,
/// out of range or not finite, Error{unsupported} for a file that requires an extension that might change nodes,
/// Error{not_found}, Error{io}.
Character read_character(const std::filesystem::path& path);
/// The same from bytes; `name` is used as the file name in errors.
Character read_character_bytes(const std::string& name, std::string_view bytes);

}  // namespace signweave
