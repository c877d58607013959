#pragma once

#include <array>
#include <vector>

#include "signweave/features/phalanges.h"
#include "signweave/motion/kinematics.h"
#include "signweave/transition/gap.h"

namespace signweave {

/// Two fingers of a made hand may be so much deeper in each other than on both sides of the gap. Metres.
inline constexpr float kFingerDepthAllowed = 0.002f;

/// Keeps the fingers of one hand that were made out of each other. Made once per signer, it belongs to one thread; the
/// second gap of some length allocates nothing. (ours)
class FingerGuard {
 public:
  FingerGuard() = default;
  FingerGuard(const Skeleton& skeleton, const RigMap& rig, Side side);

  /// False for a hand without fingers: then nothing else may be called.
  bool known() const noexcept { return skeleton_ != nullptr; }

  /// The hand on both sides of the gap that is looked at next.
  void set_borders(const HandPoints& left, const HandPoints& right) noexcept;
  /// Whether some fingers are deeper in each other than at either border, and kFingerDepthAllowed.
  bool crosses(const HandPoints& hand) noexcept;

  /// Bends the two fingers that are deepest beyond that out of each other, each half the way, where they are deepest:
  /// knuckle and second joint by the hinges that fingers have, the thumb at its first joint. The bend fades out to
  /// nothing at both borders, level there. Repeated until no frame is too deep, at most kRounds times by each of three
  /// ways out; of all rounds that one stays whose deepest frame is least deep. Answers whether anything was bent.
  bool mend(const Gap& gap, MutablePoses made);

  static constexpr int kRounds = 8;

 private:
  /// A turn of one joint about an axis in its parent's space.
  struct Hinge {
    JointIndex joint = kNoJoint;
    Eigen::Vector3f axis = Eigen::Vector3f::Zero();
    float angle = 0;  ///< radians
  };
  struct Worst {
    std::int64_t frame = -1;  ///< below 0: no frame is too deep
    FingerCrossing crossing;
  };
  struct Hinges {
    std::array<Hinge, 6> all;
    std::size_t count = 0;
  };

  /// Where one finger went through another the nearest way out leads back on one side and on on the other, and rounds
  /// may go to and fro.
  enum class Way : std::uint8_t {
    nearest,  ///< in each round anew
    first,    ///< the nearest one of the first round, and on in that direction
    other,    ///< the opposite direction
  };

  void read(PoseView pose);
  bool mend(const Gap& gap, Way by, float& least, MutablePoses made);
  Worst look(const Gap& gap, MutablePoses made);
  Hinges way_out(const FingerCrossing& crossing, Way by);
  void lead_out(const FingerCrossing::One& one, const Eigen::Vector3f& way, const HandAxes& axes, Hinges& hinges) const;

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
  std::vector<Eigen::Quaternionf> best_;  ///< [frame][bent joint]
};

}  // namespace signweave
