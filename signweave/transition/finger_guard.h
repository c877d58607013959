#pragma once

#include <array>
#include <optional>
#include <vector>

#include "signweave/features/phalanges.h"
#include "signweave/motion/kinematics.h"
#include "signweave/transition/gap.h"

namespace signweave {

/// How much deeper two fingers of a generated hand may be in each other than on both sides of the gap. Metres.
inline constexpr float kFingerDepthAllowed = 0.002f;

/// Keeps the generated fingers of one hand out of each other. Created once per signer; used by one thread. A second gap
/// of the same length allocates nothing. (ours) More than fifteen members: the hand's data, then buffers of the current
/// gap.
class FingerGuard {
 public:
  FingerGuard() = default;
  FingerGuard(const Skeleton& skeleton, const RigMap& rig, Side side);

  /// False for a hand without fingers; then no other function may be called.
  bool known() const noexcept { return skeleton_ != nullptr; }

  /// If two fingers are deeper in each other than at either border plus kFingerDepthAllowed, bends the pair with the
  /// largest excess apart at its deepest frame, each finger by half: knuckle and second joint about their anatomical
  /// hinges, the thumb at its first joint. The bend fades out to zero with zero slope at both borders. Repeated until
  /// no frame is too deep, at most kRounds times for each of three exit directions; the round whose deepest frame is
  /// least deep is used.
  ///
  /// Not every frame is examined. Frames between two examined ones are skipped if no two fingers move so far past each
  /// other that one could have been 1.5 mm deeper in the other, or if each stays on its side. Returns true if anything
  /// was changed.
  bool repair(const Gap& gap, MutablePoses made);

  static constexpr int kRounds = 8;

 private:
  /// A rotation of one joint about an axis in its parent's space.
  struct Hinge {
    JointIndex joint = kNoJoint;
    Eigen::Vector3f axis = Eigen::Vector3f::Zero();
    float angle = 0;  ///< radians
  };
  /// One correction that moves two fingers apart.
  struct Correction {
    std::array<Hinge, 6> hinges;
    std::size_t count = 0;
    float peak = 0;  ///< the moment of full effect, from 0 to 1
  };
  /// Two points of a finger, in the space of the wrist joint.
  struct FingerPoints {
    Eigen::Vector3f tip = Eigen::Vector3f::Zero();
    Eigen::Vector3f joint = Eigen::Vector3f::Zero();  ///< in the middle of the finger
  };
  /// The relative position of two fingers.
  struct PairState {
    float depth = 0;                                 ///< as in FingerPair
    Eigen::Vector3f away = Eigen::Vector3f::Zero();  ///< unit, from the second to the first; zero if they are far apart
  };
  /// An examined frame.
  struct Knot {
    std::int64_t frame = 0;  ///< -1: the left border; `count`: the right one
    std::array<FingerPoints, kFingers.size()> fingers;
    std::array<PairState, kFingerPairs> pairs;
    std::optional<FingerCrossing> crossing;  ///< the worst
    std::size_t as_made = 0;                 ///< index into kept_ of the rotations of its bent joints
  };

  /// The direction in which fingers are moved apart. If one finger passed through another, the nearest exit leads back
  /// on one side and onwards on the other, so rounds that always use the nearest may oscillate.
  enum class Exit : std::uint8_t {
    nearest,  ///< chosen again in each round
    first,    ///< the nearest of the first round, then the same direction
    other,    ///< the opposite direction
  };

  void read(PoseView pose);
  Knot knot_at(std::int64_t frame);
  void look(Knot& knot);
  bool may_hide(const Knot& a, const Knot& b) const;
  bool refine();
  bool lead_out(Exit by, float& least);
  Correction correction_for(const FingerCrossing& crossing, Exit by);
  void lead_out(const FingerCrossing::One& one, const Eigen::Vector3f& direction, const HandAxes& axes,
                Correction& correction) const;
  void apply(const Correction& correction, std::int64_t frame) const;
  MutablePoseView pose_of(std::int64_t frame) const noexcept;

  const Skeleton* skeleton_ = nullptr;
  Side side_ = Side::left;
  std::vector<HandPlaces> places_;                                   ///< exactly one
  std::array<std::array<JointIndex, 2>, kFingers.size()> joints_{};  ///< [Finger] the first two joints of each
  std::vector<JointIndex> bent_;                                     ///< all of them
  JointChains chains_;                                               ///< in the space of the wrist joint
  FingerRadii radii_{};
  FingerDepths allowed_{};
  std::array<Eigen::Vector3f, kFingerPairs> away_;  ///< [pair] direction of its first correction; zero: none
  ModelPose pose_;
  HandPoints points_;
  Phalanges phalanges_;
  FingerPairs pairs_;
  // State of the current gap:
  const Gap* gap_ = nullptr;
  MutablePoses made_;
  std::vector<Knot> knots_, added_;       ///< by frame, including both borders
  std::vector<Eigen::Quaternionf> kept_;  ///< [knot in the order of examination][bent joint]
  std::vector<Correction> corrections_;
};

}  // namespace signweave
