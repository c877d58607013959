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

/// True if nothing is changed.
inline bool is_as_captured(const StrokeChange& change) noexcept {
  return !change.arms[0] && !change.arms[1] && change.trunk_yaw == 0;
}

/// A number that differs for other changes, for caches.
std::uint64_t checksum_of(const StrokeChange& change);

/// Where a change comes from.
enum class ChangeBasis : std::uint8_t {
  asked = 0,      ///< the numbers were asked for
  captured = 1,   ///< the token was captured with these loci; nothing is changed
  learned = 2,    ///< learned from the gloss' tokens
  geometric = 3,  ///< from one token, by geometry
};
inline constexpr std::array kChangeBases = {ChangeBasis::asked, ChangeBasis::captured, ChangeBasis::learned,
                                            ChangeBasis::geometric};
std::string_view name_of(ChangeBasis basis) noexcept;

/// A change of a clip's stroke, with what reports say of it.
struct ClipChange {
  std::string asked;  ///< as in an utterance: "to @left"
  ChangeBasis basis = ChangeBasis::asked;
  std::string because;  ///< the reason for the basis, in one sentence; may be empty
  StrokeChange stroke;
  float moved_mm = 0;        ///< the largest displacement of a palm over the stroke
  float turned_degrees = 0;  ///< the largest turn of a hand
  float share = 1;           ///< of what was asked for that is reached
  std::string limit;         ///< why not all of it; empty if `share` is 1
  float missed_mm = 0;       ///< from where the stroke should end
  float aim_degrees = 0;     ///< of a pointing sign: from the direction to its locus
  friend bool operator==(const ClipChange&, const ClipChange&) = default;
};

/// Throws Error{bad_input} unless all numbers are finite and within sane limits, and `path` has at most
/// kMostPathPoints.
void check(const StrokeChange& change);
inline constexpr std::size_t kMostPathPoints = 64;

}  // namespace signweave
