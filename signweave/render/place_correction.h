#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/motion/motion.h"
#include "signweave/render/anchor.h"
#include "signweave/render/hand_meter.h"
#include "signweave/transition/arm_reach.h"
#include "signweave/transition/gap.h"
#include "signweave/transition/joint_groups.h"
#include "signweave/transition/wrist_limits.h"

namespace signweave {

// An arm of one clip is put on the trunk of another by copying its local rotations. The hand then keeps its place in
// the chest, but not in front of the signer, nor at the head. The correction below gives it the place that it had in
// its source. (ours)

/// How much deeper a corrected hand may be inside the body than in its source. Metres.
inline constexpr float kDepthOfHandAllowed = 0.003f;

/// The correction of one arm over one stroke. In the space `kept_in` it is one constant rigid motion, a shift by `out`,
/// which is zero unless the hand would be too deep: within the stroke the hand moves there exactly as in its source.
struct PlaceCorrection {
  Side side = Side::left;
  Anchor anchor = Anchor::signer_space;           ///< of the source's stroke
  Anchor kept_in = Anchor::signer_space;          ///< the space in which the hand keeps its place; never other_hand
  bool none = true;                               ///< copying already gives the wanted place
  Eigen::Vector3f out = Eigen::Vector3f::Zero();  ///< out of the body; metres, axes of `kept_in` (the head's joint, …)

  // The rigid motion from the palm as copied to the palm as corrected, relative to the trunk that carries the arm: the
  // mean over the stroke, in the signer's axes.
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();           ///< of the middle of the palm's path, metres
  Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();  ///< about that middle
  float size_mm = 0;                                         ///< the largest displacement of the palm over the stroke
  float size_degrees = 0;                                    ///< the largest turn of the hand
  float varies_mm = 0;       ///< largest distance of the corrected palm from the mean motion above: 0 unless the trunks
  float varies_degrees = 0;  ///< (or the head) move relative to each other during the stroke

  /// Why the hand cannot keep its place: "the right hand cannot reach the place of 'X' with this trunk: 42 mm too far".
  std::optional<std::string> why_not;
};

/// One stroke of a clip whose arms are put on another trunk. Everything is borrowed; both views have the same frames.
struct ComposedStroke {
  std::string_view name;              ///< of the sign, for reasons
  PosesView source;                   ///< the clip's whole body, standing where the composed signer stands
  PosesView composed;                 ///< with the clip's arms copied, not yet corrected
  std::array<bool, 2> from_source{};  ///< [Side] the arms that come from the clip, with their fingers
};

/// Finds corrections, and applies them. Created once per signer; used by one thread. After the first call nothing is
/// allocated, except for reasons and for longer strokes than before.
class ArmPlacer {
 public:
  /// `skeleton` and `signer` must outlive this.
  ArmPlacer(const Skeleton& skeleton, const SignerModel& signer, const JointGroups& groups);

  /// Returns the correction of each arm that comes from the clip, [Side]. What a hand touches in any frame of the
  /// source determines its anchor (anchor_of). Hands that touch each other keep to each other: both have the same
  /// `kept_in`, determined by everything else that they touch, and the same `out`; if only one of them comes from the
  /// clip, there is a `why_not` (lint L1).
  ///
  /// A hand that would be deeper in trunk or head than at the deepest source frame plus kDepthOfHandAllowed is moved
  /// out by at most kMostOut. There is a `why_not` if it still is, if the wrist would be more than kMissAllowed from
  /// its place because the arm is too short or the elbow would leave 29° to 178°, or if the wrist would bend beyond
  /// human limits (WristLimits, widened by the source's bend). The other hand is not considered, because it may be
  /// corrected too: see HandMeter::meeting.
  std::array<std::optional<PlaceCorrection>, 2> corrections(const ComposedStroke& stroke);

  /// Moves the arm from its current place in `composed` towards the corrected one by weights from 0 to 1, one per
  /// frame: the rotations of shoulder, elbow and wrist are interpolated; everything else keeps its bits, and so does a
  /// whole frame of weight 0. Clavicle, helper joints and fingers must be copies of the source's. A frame depends on
  /// the source's and the composed pose at this frame, its weight and the correction only.
  ///
  /// Between two strokes of one clip chain, apply the earlier correction with weight 1 until the later one, applied
  /// second, has weight 1: the hand then goes from place to place, without a detour through the place as copied. For a
  /// correction that is `none`, the corrected place is the copied one.
  void apply(const PlaceCorrection& correction, PosesView source, std::span<const float> weights,
             MutablePoses composed);

  HandMeter& meter() noexcept { return meter_; }

  static constexpr float kMostOut = 0.03f;       ///< metres
  static constexpr float kMissAllowed = 0.001f;  ///< metres

 private:
  struct Arm {
    ArmJoints joints;
    JointChains with_anchors;    ///< the wrist, both shoulders, head and trunk, with their ancestors
    JointChains with_body;       ///< these and what a HandMeter reads, but only the arm below the shoulder
    JointChains with_hand;       ///< and the hand
    JointChains below_shoulder;  ///< down to the wrist
    JointChains hand_below_shoulder;
  };
  /// One arm in one frame.
  struct Placed {
    float missed = 0;               ///< metres from the wanted place; negative: the elbow cannot bend that much
    Eigen::Quaternionf space_turn;  ///< model from the axes of `kept_in`
    RigidMotion copied, corrected;  ///< model from the wrist's joint
  };
  struct Fit;
  /// The hand in a frame of the source.
  struct SourceHand {
    Eigen::Vector3f palm = Eigen::Vector3f::Zero();  ///< in the space of the wrist's joint
    WristBend bend;
  };
  SourceHand look_at_source(PoseView pose, Side side);
  /// The palm at one frame of a stroke: signer-centred, metres.
  struct Palm {
    Eigen::Vector3f copied, corrected;
    Eigen::Quaternionf turn;  ///< of the hand
  };

  const Arm& arm(Side side) const noexcept { return arms_[static_cast<std::size_t>(side)]; }
  void add_arm(Side side, const SignerModel& signer, const JointGroups& groups);
  /// Precondition: source_ and target_ hold the joints with_anchors of both poses.
  Placed place(const PlaceCorrection& correction, PoseView source, float weight, MutablePoseView pose);
  Fit fit(const ComposedStroke& stroke, const PlaceCorrection& correction, const HandDepths& captured);
  /// Finds `out` for arms that keep to each other, and the sizes.
  void correct(const ComposedStroke& stroke, std::span<PlaceCorrection> together);
  void set_sizes(PlaceCorrection& correction) const;
  static std::optional<std::string> why_not(std::string_view name, Side side, const Fit& fit);
  bool has(Side side) const noexcept { return meter_.has(side) && arm(side).joints.wrist != kNoJoint; }

  const Skeleton* skeleton_;
  std::array<Arm, 2> arms_;  ///< [Side]
  AnchorSpaces spaces_;
  HandMeter meter_, source_meter_;
  ModelPose source_, target_;
  Pose pose_;
  std::vector<Palm> palms_;  ///< [frame] of the stroke and arm that were fitted last
};

/// Why both hands cannot be as composed (lint L5): they are deeper in each other than kDepthOfHandAllowed beyond the
/// deepest captured meeting, or crossed as in none of them. `captured` are the meetings of the clips from which the
/// hands come. "the hands are 12 mm deeper in each other than captured".
std::optional<std::string> why_hands_collide(const HandsMeeting& made, std::span<const HandsMeeting> captured);

}  // namespace signweave
