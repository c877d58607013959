#pragma once

#include <array>
#include <cstdint>
#include <limits>
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
/// Those of trunk and head, which come first.
inline constexpr std::array kBodyObstacles = {Obstacle::left_trunk, Obstacle::right_trunk, Obstacle::head};
/// "trunk", "trunk", "head", "other hand".
std::string_view name_of(Obstacle obstacle) noexcept;

/// Depth of a hand in trunk and head: metres, negative: minus (a lower bound of) their distance.
using HandDepths = std::array<float, kBodyObstacles.size()>;  ///< [Obstacle]

/// The relation of both hands over some frames.
struct HandsMeeting {
  static constexpr float kNever = -std::numeric_limits<float>::max();
  float depth = kNever;    ///< how deep one hand is in the other, metres, at the deepest frame; negative: apart, and
                           ///< beyond twice the gap of a contact (kContactGap) only a bound
  float crossed = kNever;  ///< how far the right palm is on the left palm's left side, metres, at most; negative: never
};

/// True if a frame has the bits of the one before it, as in a held pose.
bool is_held(const PosesView& poses, std::int64_t frame) noexcept;

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
  /// The same without the other hand. Precondition: has(side).
  void look(PoseView pose, Side side);
  /// The same in a pose that holds at least joints(side) in model space. `pose()` stays as it is.
  void look(const ModelPose& pose, Side side);
  /// The joints of the body and a hand that are read, with their ancestors.
  const JointSet& joints(Side side) const noexcept { return hand(side).chains.joints(); }
  const ModelPose& pose() const noexcept { return pose_; }
  const SignerSpace& space() const noexcept { return space_; }
  /// Preconditions: has(side); for `axes`, has_fingers(side).
  Eigen::Vector3f palm(Side side) const noexcept { return palm_of(hand(side).points); }
  HandAxes axes(Side side) const noexcept { return axes_of(hand(side).points, side); }
  /// What the hand touches, and what is known already, which is not examined.
  Contact touched(Side side, Contact known = Contact::none) const noexcept;
  /// The approach of the hand to an obstacle; far away, only a lower bound. `away` is never zero if they overlap.
  Approach to(Side side, Obstacle obstacle) const noexcept;

  /// Everything that the hand touches over some frames.
  Contact touched(PosesView poses, Side side);
  /// The depth in trunk and head at the deepest frame.
  HandDepths deepest(PosesView poses, Side side);
  /// Precondition: both hands are known.
  HandsMeeting meeting(PosesView poses);
  /// Adds the pose to the meeting of those before.
  void meet(HandsMeeting& meeting) const noexcept;

 private:
  struct Hand {
    std::optional<HandPlaces> places;
    JointChains chains;  ///< of the body and this hand
    HandPoints points;
    HandShell shell;
  };
  const Hand& hand(Side side) const noexcept { return hands_[static_cast<std::size_t>(side)]; }
  void look_at_body(const ModelPose& pose);
  void look_at_hand(const ModelPose& pose, Side side);

  const SignerModel* signer_ = nullptr;
  JointChains chains_;
  std::array<Hand, 2> hands_;  ///< [Side]
  BodyShell body_;
  SignerSpace space_;
  ModelPose pose_;
};

}  // namespace signweave
