#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "signweave/features/capsule_row.h"
#include "signweave/features/contact.h"
#include "signweave/features/hand_points.h"
#include "signweave/motion/kinematics.h"
#include "signweave/transition/arm_reach.h"
#include "signweave/transition/gap.h"

namespace signweave {

/// A part of the arm, and the part of the body that it may collide with.
enum class Meeting : std::uint8_t {
  hand_left_trunk = 0,  ///< the hand and the left side of the trunk
  hand_right_trunk = 1,
  hand_head = 2,
  hand_hand = 3,  ///< the hand and the other hand
  forearm_left_trunk = 4,
  forearm_right_trunk = 5,
};
inline constexpr std::size_t kMeetings = 6;
inline constexpr bool is_of_hand(std::size_t meeting) noexcept {
  return meeting < static_cast<std::size_t>(Meeting::forearm_left_trunk);
}

/// The penetration depth of two parts.
struct Depth {
  float depth = 0;                                ///< metres; negative: minus a lower bound of their distance
  Eigen::Vector3f out = Eigen::Vector3f::Zero();  ///< unit, moves the arm out; valid only if they overlap
  float along = 1;                                ///< position on the forearm: 0 at the elbow, 1 at the wrist
  bool by_shape = false;                          ///< computed from the hand's bars, so the hand's orientation matters
};
using Depths = std::array<Depth, kMeetings>;  ///< [Meeting]

/// The joints of an arm that its meetings depend on; metres, model space.
struct ArmPlace {
  Eigen::Vector3f elbow = Eigen::Vector3f::Zero();
  Eigen::Vector3f wrist = Eigen::Vector3f::Zero();
  Eigen::Quaternionf hand = Eigen::Quaternionf::Identity();  ///< model from the wrist's joint
};

/// The arms in the frames of one gap, and what they may collide with. While one arm is corrected, trunk, head, the
/// other arm and the shapes of both hands do not change: each is computed on demand, once a frame. Frame -1 is the left
/// border and frame `count` the right one. Created once per signer; a second gap of the same length allocates nothing.
class BodyScene {
 public:
  BodyScene() = default;
  /// Has no arms if the body's size is unknown. `skeleton` and `signer` must outlive the scene.
  BodyScene(const Skeleton& skeleton, const SignerModel& signer, const JointGroups& groups);

  bool has(Side side) const noexcept { return arm(side).hand.has_value(); }
  const ArmJoints& joints(Side side) const noexcept { return arm(side).joints; }
  bool has_fingers(Side side) const noexcept { return has(side) && arm(side).hand->why_no_fingers().empty(); }

  /// Starts with another gap and clears all cached values. Both arguments are borrowed until the next call.
  void begin(const Gap& gap, MutablePoses made);
  std::int64_t count() const noexcept { return gap_->count; }
  /// Invalidates the cached values of an arm and its hand in the frames of the gap, after they were changed.
  void changed(Side side);

  /// Computes the arm's current position; pose() then holds the joints from its shoulder's parent down to its wrist.
  ArmPlace place(Side side, std::int64_t frame);
  /// The same for an arm that is not being corrected: computed once.
  const ArmPlace& stored_place(Side side, std::int64_t frame);
  /// Computes the arm's current depth in every part; pose() then holds the arm. Depths of distant parts are bounds.
  ArmPlace look(Side side, std::int64_t frame, Depths& depths);
  const ModelPose& pose() const noexcept { return pose_; }

  /// The points of a hand, in the space of its wrist joint.
  const HandPoints& hand(Side side, std::int64_t frame) { return hand_of(side, frame).points; }
  /// The distance from the wrist to the farthest point of the hand, metres.
  float reach(Side side, std::int64_t frame) { return hand_of(side, frame).from_wrist; }
  /// The palm (see palm_of) of a hand placed at `there`, model space.
  Eigen::Vector3f palm(Side side, std::int64_t frame, const ArmPlace& there) {
    return there.wrist + there.hand * palm_of(hand(side, frame));
  }
  /// The point between the shoulders, metres, model space.
  const Eigen::Vector3f& origin(std::int64_t frame) { return body_of(frame).origin; }
  /// The vector from the elbow to the wrist, in the space of the wrist joint; not normalized.
  Eigen::Vector3f forearm(Side side, std::int64_t frame) const;

  PoseView pose_of(std::int64_t frame) const noexcept;
  MutablePoseView made(std::int64_t frame) const noexcept;

 private:
  /// A joint between the wrist (inclusive) and the elbow (exclusive).
  struct Link {
    JointIndex joint = kNoJoint;
    std::ptrdiff_t translation = -1;  ///< index in the pose; negative: the joint has a fixed offset
    Eigen::Vector3f offset = Eigen::Vector3f::Zero();
  };
  struct Arm {
    ArmJoints joints;
    JointIndex above = kNoJoint;  ///< the shoulder's parent
    std::vector<Link> forearm;    ///< the wrist first
    std::optional<HandPlaces> hand;
    JointChains chain;    ///< from below `above` down to the wrist
    JointChains fingers;  ///< in the space of the wrist joint
  };
  struct Body {
    BodyShell shell;
    Eigen::Vector3f origin = Eigen::Vector3f::Zero();
    Eigen::Vector3f forward = Eigen::Vector3f::Zero();
    std::array<Eigen::Quaternionf, 2> above_rotation;  ///< [Side] of the shoulder's parent
    std::array<Eigen::Vector3f, 2> above_position;
  };
  struct Hand {
    HandPoints points;  ///< in the space of the wrist joint, like the other members
    CapsuleRow bars;
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();  ///< of a bounding sphere of all bars
    float reach = 0;
    float from_wrist = 0;  ///< to the farthest point
  };
  /// Values computed for some frames. Its memory is reused.
  template <class Value>
  struct Known {
    std::vector<std::int32_t> at;  ///< [frame + 1] index into `values`; negative: not computed
    std::vector<Value> values;

    void begin(std::size_t frames) {
      at.assign(frames, -1);
      values.clear();
      values.reserve(frames);  // keeps references valid
    }
    const Value* find(std::int64_t frame) const noexcept {
      const std::int32_t index = at[static_cast<std::size_t>(frame + 1)];
      return index < 0 ? nullptr : &values[static_cast<std::size_t>(index)];
    }
    Value& add(std::int64_t frame) {
      at[static_cast<std::size_t>(frame + 1)] = static_cast<std::int32_t>(values.size());
      return values.emplace_back();
    }
  };

  const Arm& arm(Side side) const noexcept { return arms_[static_cast<std::size_t>(side)]; }
  const Body& body_of(std::int64_t frame);
  const Hand& hand_of(Side side, std::int64_t frame);
  Depth hand_in(const Capsule& part, Side side, std::int64_t frame, const ArmPlace& here);
  Depth hand_in_hand(Side side, std::int64_t frame, const ArmPlace& here);

  const Skeleton* skeleton_ = nullptr;
  const SignerModel* signer_ = nullptr;
  std::array<Arm, 2> arms_;
  JointChains trunk_;  ///< including the head
  const Gap* gap_ = nullptr;
  MutablePoses made_;
  std::array<float, 2> max_reach_{};  ///< [Side] maximum reach of the hand from its wrist, metres
  Known<Body> bodies_;
  std::array<Known<Hand>, 2> hands_;       ///< [Side]
  std::array<Known<ArmPlace>, 2> places_;  ///< [Side]
  std::array<Hand, 2> bars_;               ///< [Side] of a hand without fingers
  ModelPose pose_, in_hand_;
};

}  // namespace signweave
