#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/rig/part.h"

namespace signweave {

/// Displaces a hand at one moment of a stroke.
struct PathPoint {
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();  ///< of the palm, metres
  Eigen::Vector3f turn = Eigen::Vector3f::Zero();   ///< of the hand: axis times angle, radians
  float swivel = 0;                                 ///< of the elbow about the line from shoulder to wrist, radians
  friend bool operator==(const PathPoint&, const PathPoint&) = default;
};

/// Where one hand goes instead of where it was captured. In the axes of the signer-centred space of the stroke's first
/// frame, which stays where it is during the stroke; metres from its origin.
struct ArmChange {
  /// The palm goes to `to` + `linear` · (palm − `from`).
  Eigen::Matrix3f linear = Eigen::Matrix3f::Identity();
  Eigen::Vector3f from = Eigen::Vector3f::Zero();
  Eigen::Vector3f to = Eigen::Vector3f::Zero();
  Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();  ///< of the hand, about the palm
  float swivel = 0;                                          ///< as in PathPoint
  /// The arm is turned about its shoulder by this before it reaches for the palm's place: where the elbow goes.
  Eigen::Quaternionf carry = Eigen::Quaternionf::Identity();
  /// At equal steps from the first to the last frame of the stroke; added to the above. Empty, one for all frames, or
  /// more, between which natural cubic splines are taken.
  std::vector<PathPoint> path;
  friend bool operator==(const ArmChange& a, const ArmChange& b) noexcept;
};

/// A stroke that is changed in space, as fitted to the signer: with these numbers and the captured frames the changed
/// ones are made, frame by frame.
struct StrokeChange {
  std::array<std::optional<ArmChange>, 2> arms;  ///< [Side]; none: as captured
  /// The hands keep to each other: the map and path of both, which are equal, apply to the middle between the palms.
  bool together = false;
  float trunk_yaw = 0;  ///< of the trunk above the waist, radians; positive: to the signer's left
  /// Frames before and after the stroke over which the change begins and ends.
  std::int64_t before = 1, after = 1;
  friend bool operator==(const StrokeChange&, const StrokeChange&) = default;
};

}  // namespace signweave
