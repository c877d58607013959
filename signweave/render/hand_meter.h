#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "signweave/features/contact.h"
#include "signweave/features/hand_motion.h"
#include "signweave/features/hand_points.h"
#include "signweave/transition/gap.h"

namespace signweave {

/// A part that a hand can touch or enter.
enum class Obstacle : std::uint8_t {
  left_trunk = 0,
  right_trunk = 1,
  head = 2,
  other_hand = 3,
};
inline constexpr std::size_t kObstacles = 4;
/// "trunk", "trunk", "head", "other hand".
std::string_view name_of(Obstacle obstacle) noexcept;

/// Depth of a hand in each obstacle: metres, negative: minus (a lower bound of) their distance.
using HandDepths = std::array<float, kObstacles>;  ///< [Obstacle]

/// The relation of both hands over some frames.
struct HandsMeeting {
  float depth = 0;    ///< how deep one hand is in the other, metres, at the deepest frame; negative: apart
  float crossed = 0;  ///< how far the right palm is on the left palm's left side, metres, at most; negative: never
};

/// Measures hands against body and each other, with the capsules of features/contact.h, in one pose after another.
/// After the first pose it allocates nothing.
class HandMeter {
 public:
  HandMeter() = default;
  /// Measures nothing if the body's size is unknown. `signer` must outlive this.
  HandMeter(const Skeleton& skeleton, const SignerModel& signer);

  bool has(Side side) const noexcept { return signer_ != nullptr && hand(side).places.has_value(); }
  bool has_fingers(Side side) const noexcept { return has(side) && hand(side).places->why_no_fingers().empty(); }

  /// Reads a pose, of which the functions below speak.
  void look(PoseView pose);
  const ModelPose& pose() const noexcept { return pose_; }
  const SignerSpace& space() const noexcept { return space_; }
  /// Preconditions: has(side); for `axes`, has_fingers(side).
  Eigen::Vector3f palm(Side side) const noexcept { return palm_of(hand(side).points); }
  HandAxes axes(Side side) const noexcept { return axes_of(hand(side).points, side); }
  Contact touched(Side side) const noexcept;
  /// The approach of the hand to an obstacle; far away, only a lower bound. `away` is never zero if they overlap.
  Approach to(Side side, Obstacle obstacle) const noexcept;

  /// Everything that the hand touches over some frames.
  Contact touched(PosesView poses, Side side);
  /// The depth in each obstacle at the deepest frame.
  HandDepths deepest(PosesView poses, Side side);
  /// Precondition: both hands are known.
  HandsMeeting meeting(PosesView poses);

 private:
  struct Hand {
    std::optional<HandPlaces> places;
    HandPoints points;
    HandShell shell;
  };
  const Hand& hand(Side side) const noexcept { return hands_[static_cast<std::size_t>(side)]; }

  const SignerModel* signer_ = nullptr;
  JointChains chains_;
  std::array<Hand, 2> hands_;  ///< [Side]
  BodyShell body_;
  SignerSpace space_;
  ModelPose pose_;
};

}  // namespace signweave
