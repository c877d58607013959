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

/// What an arm may run into, and which part of it.
enum class Meeting : std::uint8_t {
  hand_left_trunk = 0,  ///< the hand, and the left side of the trunk
  hand_right_trunk = 1,
  hand_head = 2,
  hand_hand = 3,  ///< the hand, and the other hand
  forearm_left_trunk = 4,
  forearm_right_trunk = 5,
};
inline constexpr std::size_t kMeetings = 6;
inline constexpr bool is_of_hand(std::size_t meeting) noexcept {
  return meeting < static_cast<std::size_t>(Meeting::forearm_left_trunk);
}

/// How deep two parts are in each other.
struct Depth {
  float depth = 0;                                ///< metres; below 0: they are so far apart, or farther
  Eigen::Vector3f out = Eigen::Vector3f::Zero();  ///< unit, leads the arm out; looked at where they are not apart
  float along = 1;                                ///< where on the forearm: 0 at the elbow, 1 at the wrist
  bool by_shape = false;                          ///< of the hand's bars, so that its turning counts
};
using Depths = std::array<Depth, kMeetings>;  ///< [Meeting]

/// Where the joints of an arm are that its meetings depend on; metres, model space.
struct ArmPlace {
  Eigen::Vector3f elbow = Eigen::Vector3f::Zero();
  Eigen::Vector3f wrist = Eigen::Vector3f::Zero();
  Eigen::Quaternionf hand = Eigen::Quaternionf::Identity();  ///< model from the wrist's joint
};

/// The arms of the frames of one gap beside what they may run into. While an arm is bent, trunk, head, the other arm
/// and the shapes of both hands stand still: each is computed once a frame, and only when asked for. Frame -1 is the
/// left border and frame `count` the right one. Made once per signer; the second gap of some length allocates nothing.
class BodyScene {
 public:
  BodyScene() = default;
  /// Where the body's size is not known, no arm is; `skeleton` and `signer` must outlive the scene.
  BodyScene(const Skeleton& skeleton, const SignerModel& signer, const JointGroups& groups);

  bool has(Side side) const noexcept { return arm(side).hand.has_value(); }
  const ArmJoints& joints(Side side) const noexcept { return arm(side).joints; }
  bool has_fingers(Side side) const noexcept { return has(side) && arm(side).hand->why_no_fingers().empty(); }

  /// Begins with another gap, of which nothing is known yet. Borrowed until the next.
  void begin(const Gap& gap, MutablePoses made);
  std::int64_t count() const noexcept { return gap_->count; }
  /// Forgets what is known of an arm and its hand in the frames of the gap, as they were changed.
  void changed(Side side);

  /// Where the arm is now, and in pose() the joints from above its shoulder down to its wrist.
  ArmPlace place(Side side, std::int64_t frame);
  /// The same, of an arm that is not being bent: computed once.
  const ArmPlace& stored_place(Side side, std::int64_t frame);
  /// How deep the arm is in everything, as it is now; leaves the arm in pose(). (depths of parts far apart are bounds)
  ArmPlace look(Side side, std::int64_t frame, Depths& depths);
  const ModelPose& pose() const noexcept { return pose_; }

  /// The points of a hand, in the space of its wrist's joint.
  const HandPoints& hand(Side side, std::int64_t frame) { return hand_of(side, frame).points; }
  /// From the wrist to what is farthest of the hand, metres.
  float reach(Side side, std::int64_t frame) { return hand_of(side, frame).from_wrist; }
  /// Its palm_of, model space, of a hand that is there.
  Eigen::Vector3f palm(Side side, std::int64_t frame, const ArmPlace& there) {
    return there.wrist + there.hand * palm_of(hand(side, frame));
  }
  /// Between the shoulders, metres, model space.
  const Eigen::Vector3f& origin(std::int64_t frame) { return body_of(frame).origin; }
  /// From the elbow to the wrist in the space of the wrist's joint; not of unit length.
  Eigen::Vector3f forearm(Side side, std::int64_t frame) const;

  PoseView pose_of(std::int64_t frame) const noexcept;
  MutablePoseView made(std::int64_t frame) const noexcept;

 private:
  /// A joint from the wrist up to below the elbow.
  struct Link {
    JointIndex joint = kNoJoint;
    std::ptrdiff_t translation = -1;  ///< of the pose; below 0 where the offset stands
    Eigen::Vector3f offset = Eigen::Vector3f::Zero();
  };
  struct Arm {
    ArmJoints joints;
    JointIndex above = kNoJoint;  ///< the shoulder's parent
    std::vector<Link> forearm;    ///< the wrist first
    std::optional<HandPlaces> hand;
    JointChains chain;    ///< below `above`, down to the wrist
    JointChains fingers;  ///< in the space of the wrist's joint
  };
  struct Body {
    BodyShell shell;
    Eigen::Vector3f origin = Eigen::Vector3f::Zero();
    Eigen::Vector3f forward = Eigen::Vector3f::Zero();
    std::array<Eigen::Quaternionf, 2> above_rotation;  ///< [Side] of the joint above the shoulder
    std::array<Eigen::Vector3f, 2> above_position;
  };
  struct Hand {
    HandPoints points;  ///< in the space of the wrist's joint, as is all else
    CapsuleRow bars;
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();  ///< of a ball about all bars
    float reach = 0;
    float from_wrist = 0;  ///< to what is farthest
  };
  /// What is known of some frames, each where it was computed; its memory stays.
  template <class Value>
  struct Known {
    std::vector<std::int32_t> at;  ///< [frame + 1] in `values`; below 0: not known
    std::vector<Value> values;

    void begin(std::size_t frames) {
      at.assign(frames, -1);
      values.clear();
      values.reserve(frames);  // so that references stay
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
  JointChains trunk_;  ///< and head
  const Gap* gap_ = nullptr;
  MutablePoses made_;
  std::array<float, 2> stretched_{};  ///< [Side] as far as the hand reaches from its wrist at most, metres
  Known<Body> bodies_;
  std::array<Known<Hand>, 2> hands_;       ///< [Side]
  std::array<Known<ArmPlace>, 2> places_;  ///< [Side]
  std::array<Hand, 2> bars_;               ///< [Side] of a hand without fingers
  ModelPose pose_, in_hand_;
};

}  // namespace signweave
