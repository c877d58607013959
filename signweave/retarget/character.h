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

/// Between which angles a joint may turn, radians.
struct AngleLimits {
  float least = 0;
  float greatest = 0;
  friend bool operator==(AngleLimits, AngleLimits) = default;
};

/// A finger of a character. Vectors are model space at rest, unit; flexion counts from the straight finger, but the
/// thumb's first joint from rest.
struct CharacterFinger {
  std::array<JointIndex, 3> joints = {kNoJoint, kNoJoint, kNoJoint};  ///< from the knuckle; the thumb: from the wrist
  JointIndex metacarpal = kNoJoint;                                   ///< inside the palm; none: kNoJoint
  Eigen::Vector3f flexion_axis = Eigen::Vector3f::UnitX();  ///< a positive turn about it bends any of the joints
  Eigen::Vector3f spread_axis = Eigen::Vector3f::UnitY();   ///< of the first joint, to the thumb's side
  std::array<float, 3> rest_flexion = {0, 0, 0};            ///< radians
  std::array<AngleLimits, 3> flexion;
  AngleLimits spread;
  float slack = 0.35f;  ///< beside flexion and spread a joint may turn so much, radians

  bool known() const noexcept { return joints[0] != kNoJoint; }
};

/// A hand of a character.
struct CharacterHand {
  std::vector<JointIndex> twist;     ///< of the forearm, nearest to the hand first: they share the hand's turn
  std::vector<JointIndex> shoulder;  ///< from the collar bone to the arm's last joint before the elbow
  float length = 0;                  ///< from the wrist to the middle fingertip, metres; above 0
  std::array<CharacterFinger, kFingers.size()> fingers;  ///< [Finger]
};

/// A body that motions are put onto. At rest every joint's rotation is the identity, so that a joint's own axes are
/// those of model space. Plain data: whoever makes one by hand keeps joints within the skeleton.
struct Character {
  std::string name;
  std::shared_ptr<const Skeleton> skeleton;  ///< the root is the only translated joint
  RigMap rig;
  std::optional<SignerBody> body;                  ///< at rest; none where a shoulder is missing
  std::array<CharacterHand, 2> hands;              ///< [Side]
  Eigen::Vector3f eyes = Eigen::Vector3f::Zero();  ///< the middle between them at rest, metres, model space
  float height = 0;                                ///< top of the head, metres; 0: nothing is known of its surface
  std::vector<std::string> face_units;             ///< names of its morph targets, ascending
  /// [joint] how joints stand that nothing drives, relative to their parents; empty: as at rest.
  std::vector<Eigen::Quaternionf> still;

  Eigen::Quaternionf still_turn(std::size_t joint) const noexcept {
    return still.empty() ? Eigen::Quaternionf::Identity() : still[joint];
  }
  const CharacterHand& hand(Side side) const noexcept { return hands[static_cast<std::size_t>(side)]; }
};

/// Reads a GLB as studio/avatar/build writes it, plain or packed: nodes, the skin's joints, and what
/// asset.extras.signweave tells. Meshes and pictures are not looked at. Throws Error{bad_input, "FILE: …"} where
/// anything is missing, out of range or not finite, Error{unsupported} for a file that needs an extension which might
/// change nodes, Error{not_found}, Error{io}.
Character read_character(const std::filesystem::path& path);
/// The same from bytes; `name` stands for the file in errors.
Character read_character_bytes(const std::string& name, std::string_view bytes);

}  // namespace signweave
