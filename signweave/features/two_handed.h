#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "signweave/features/phase_features.h"
#include "signweave/features/point_track.h"
#include "signweave/rig/signer_space.h"

namespace signweave {

/// How the two hands take part in a movement. In memory only: free to renumber.
enum class Hands : std::uint8_t {
  one,          ///< the other hand rests, or is held away from it
  symmetric,    ///< both move alike at the same time, mirrored or in parallel
  alternating,  ///< both move alike, half a movement apart
  asymmetric,   ///< both take part, differently: one is held beneath the other, or they move otherwise
};
inline constexpr std::array kHandsClasses = {Hands::one, Hands::symmetric, Hands::alternating, Hands::asymmetric};
std::string_view name_of(Hands hands) noexcept;

/// The movement of both palms over some frames.
struct TwoHanded {
  struct OnePalm {
    float mean_speed = 0;    ///< metres a second
    float height = 0;        ///< mean, above the midpoint of the shoulders, shoulder widths
    float least_height = 0;  ///< shoulder widths
  };
  std::array<OnePalm, 2> palms;  ///< [Side]
  /// Correlation of the velocities, in [-1, 1], with those of one hand mirrored at the signer's median plane; 0 if a
  /// hand does not move. Not centred: a movement in one direction counts.
  float mirrored = 0;
  /// The same without the mirror: hands that move side by side.
  float parallel = 0;
  float speed_ratio = 0;     ///< mean speed of the slower hand by that of the faster, in [0, 1]; 1 if neither moves
  float openness_apart = 0;  ///< mean difference of the hands' openness, in [0, 1]; 0 if a hand has no fingers
  float least_distance = 0;  ///< of the palms, shoulder widths
  bool contact = false;      ///< the hands touch at some frame
};
/// Returns the class of a movement, the same for the mirrored signer; nullopt if neither hand moves, or a value is not
/// finite. Following Battison's (1978) types of two-handed signs: both move alike, or one is the base of the other.
/// Only the palms are examined: a change of handshape alone does not count as movement.
std::optional<Hands> class_of(const TwoHanded& movement, const SignerBody& body) noexcept;

// The borders between the classes. Those with a source are the design's starting values; the others were chosen on the
// synthetic signer, whose classes are known, and checked on captures.

/// Above this correlation, mirrored or parallel, hands move alike. Half, because a lag of 60 ms alone lowers the
/// correlation of a movement with 2.5 cycles a second to 0.6. (ours)
inline constexpr float kAlike = 0.5f;
/// Below this mean of the mirrored and the parallel correlation, which leaves out movement sideways, hands alternate.
inline constexpr float kOpposed = -0.3f;
/// Above this speed ratio both hands move; below kBaseRatio one is held.
inline constexpr float kBothMoveRatio = 0.4f;
inline constexpr float kBaseRatio = 0.25f;
/// A hand that is held nearer to the other than this, at the nearest, is its base. Shoulder widths. (ours: 0.80 at
/// most in the synthetic signer's signs on a base)
inline constexpr float kBaseReach = 0.85f;
/// A hand rests if it is below the chest at some moment and on average so much lower than the other. Shoulder widths.
/// (ours)
inline constexpr float kRestsBelow = 0.5f;
/// Hands whose openness differs by more have different handshapes and move neither alike nor in turn (the symmetry
/// condition). It takes the place of the distance of handshapes, which traces do not contain. (ours)
inline constexpr float kOtherOpenness = 0.15f;
/// Below this mean speed a palm does not move. Metres a second. (ours; a held hand of the synthetic signer has 0.01 to
/// 0.04)
inline constexpr float kStillPalm = 0.05f;

/// Above this mean speed, metres a second, a hand moves in the sense of the dominance condition.
inline constexpr float kMovingPalm = 0.15f;
/// Returns whether each hand moves, so that the symmetry condition (Battison 1978) demands one handshape.
bool both_move(const TwoHanded& movement) noexcept;

/// Computes `TwoHanded` frame by frame, and over several spans by adding their sums.
class TwoHandedSum {
 public:
  /// Adds the next frames of both palms, which must be as many. Positions are signer-centred.
  void add(std::span<const PointFrame> left, std::span<const PointFrame> right) noexcept;
  TwoHandedSum& operator+=(const TwoHandedSum& other) noexcept;
  bool empty() const noexcept { return count_ == 0; }
  /// Requires at least one frame.
  TwoHanded movement() const noexcept;

 private:
  struct OnePalm {
    double speed = 0, square = 0, height = 0;  ///< summed
    float least_height = std::numeric_limits<float>::infinity();
  };
  std::array<OnePalm, 2> palms_;
  double mirrored_ = 0, parallel_ = 0;  ///< products of the velocities, summed
  double openness_apart_ = 0;           ///< summed
  float least_distance_ = std::numeric_limits<float>::infinity();
  bool contact_ = false;
  double count_ = 0;
};

}  // namespace signweave
