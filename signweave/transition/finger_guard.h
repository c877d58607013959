#pragma once

#include <array>
#include <optional>
#include <vector>

#include "signweave/features/phalanges.h"
#include "signweave/motion/kinematics.h"
#include "signweave/transition/gap.h"

namespace signweave {

/// Two fingers of a made hand may be so much deeper in each other than on both sides of the gap. Metres.
inline constexpr float kFingerDepthAllowed = 0.002f;

/// Keeps the fingers of one hand that were made out of each other. Made once per signer, it belongs to one thread; the
/// second gap of some length allocates nothing. (ours)
/// More than fifteen members: the hand once, then buffers of the gap at hand.
class FingerGuard {
 public:
  FingerGuard() = default;
  FingerGuard(const Skeleton& skeleton, const RigMap& rig, Side side);

  /// False for a hand without fingers: then nothing else may be called.
  bool known() const noexcept { return skeleton_ != nullptr; }

  /// Where two fingers are deeper in each other than at either border, and kFingerDepthAllowed, bends the two that are
  /// deepest beyond that out of each other, each half the way, where they are deepest: knuckle and second joint by the
  /// hinges that fingers have, the thumb at its first joint. The bend fades out to nothing at both borders, level
  /// there. Repeated until no frame is too deep, at most kRounds times by each of three ways out; of all rounds that
  /// one stays whose deepest frame is least deep.
  ///
  /// Not every frame is examined: between two that are, others are skipped where no two fingers move so far past each
  /// other that one could have been 1.5 mm deeper in the other, or stay each on its side. Returns whether anything
  /// was bent.
  bool mend(const Gap& gap, MutablePoses made);

  static constexpr int kRounds = 8;

 private:
  /// A turn of one joint about an axis in its parent's space.
  struct Hinge {
    JointIndex joint = kNoJoint;
    Eigen::Vector3f axis = Eigen::Vector3f::Zero();
    float angle = 0;  ///< radians
  };
  /// How two fingers are led out of each other.
  struct Correction {
    std::array<Hinge, 6> hinges;
    std::size_t count = 0;
    float peak = 0;  ///< the moment at which it is whole, from 0 to 1
  };
  /// Two points of a finger, in the space of the wrist's joint.
  struct Place {
    Eigen::Vector3f tip = Eigen::Vector3f::Zero();
    Eigen::Vector3f joint = Eigen::Vector3f::Zero();  ///< in the middle of the finger
  };
  /// How two fingers lie beside each other.
  struct Beside {
    float depth = 0;  ///< as FingerPair has it
    Eigen::Vector3f away =
        Eigen::Vector3f::Zero();  ///< unit, from the second to the first; zero where they are far apart
  };
  /// A frame that is examined.
  struct Knot {
    std::int64_t frame = 0;  ///< -1: the left border; `count`: the right one
    std::array<Place, kFingers.size()> fingers;
    std::array<Beside, kFingerPairs> pairs;
    std::optional<FingerCrossing> crossing;  ///< the worst
    std::size_t as_made = 0;                 ///< where kept_ has the rotations of its bent joints
  };

  /// Where one finger went through another the nearest way out leads back on one side and on on the other, and rounds
  /// may go to and fro.
  enum class Way : std::uint8_t {
    nearest,  ///< in each round anew
    first,    ///< the nearest one of the first round, and on in that direction
    other,    ///< the opposite direction
  };

  void read(PoseView pose);
  Knot knot_at(std::int64_t frame);
  void look(Knot& knot);
  bool may_hide(const Knot& a, const Knot& b) const;
  bool refine();
  bool lead_out(Way by, float& least);
  Correction way_out(const FingerCrossing& crossing, Way by);
  void lead_out(const FingerCrossing::One& one, const Eigen::Vector3f& way, const HandAxes& axes,
                Correction& correction) const;
  void apply(const Correction& correction, std::int64_t frame) const;
  MutablePoseView pose_of(std::int64_t frame) const noexcept;

  const Skeleton* skeleton_ = nullptr;
  Side side_ = Side::left;
  std::vector<HandPlaces> places_;                                   ///< one
  std::array<std::array<JointIndex, 2>, kFingers.size()> joints_{};  ///< [Finger] the first two joints of each
  std::vector<JointIndex> bent_;                                     ///< all of them
  JointChains chains_;                                               ///< in the space of the wrist's joint
  FingerRadii radii_{};
  FingerDepths allowed_{};
  std::array<Eigen::Vector3f, kFingerPairs> away_;  ///< [pair] the way that it was led at first; zero: it was not
  ModelPose pose_;
  HandPoints points_;
  Phalanges phalanges_;
  FingerPairs pairs_;
  // Of the gap at hand:
  const Gap* gap_ = nullptr;
  MutablePoses made_;
  std::vector<Knot> knots_, added_;       ///< by frame, both borders among them
  std::vector<Eigen::Quaternionf> kept_;  ///< [knot in the order of examination][bent joint]
  std::vector<Correction> corrections_;
};

}  // namespace signweave
