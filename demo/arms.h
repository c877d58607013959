#pragma once

#include <array>
#include <map>
#include <tuple>
#include <vector>

#include "demo/arm.h"
#include "demo/keep_out.h"
#include "demo/plan.h"
#include "demo/signer.h"

namespace signweave::demo {

/// The trunk that arms hang on, in one frame.
struct Trunk {
  const ModelPose& model;             ///< right for trunk and head
  std::array<Capsule, 2> keep_out{};  ///< of the same pose
  double breath = 0;                  ///< −1 (out) to 1
};

/// The unrest of one arm: slow wandering of about a millimetre, and a finer, quicker one.
struct ArmUnrest {
  explicit ArmUnrest(Random& random);
  Wander place[3], tremor[3], twist, flexion, radial, swivel, fingers[kFingers];
};

/// Both arms and hands of one recording: poses them as the plan wants them, with the unrest of what lives. First
/// `look_ahead` for every frame in order, then `give_way_smoothly`, then `fill`.
class Arms {
 public:
  /// Signer and plan are borrowed.
  Arms(const Signer& signer, const HandPlan& plan, double frames_a_second, Random& random);

  /// Looks where the hands would meet each other, the head or the trunk in the next frame.
  void look_ahead(std::int64_t frame, const Trunk& trunk);
  /// Hands give way smoothly: they see the other coming.
  void give_way_smoothly();
  /// Writes the joints from the clavicles to the fingertips.
  void fill(std::int64_t frame, const Trunk& trunk, MutablePoseView pose);

 private:
  struct PosedArm {
    Eigen::Vector3f shoulder;
    Eigen::Quaternionf clavicle, chest;
    ArmPose arm;
  };
  /// One arm and hand, as the left one (the right in the mirror).
  struct Limb {
    Eigen::Vector3f wrist;  ///< where it is wanted
    WristAngles angles;
    FingerRotations fingers;
    PosedArm posed;
    std::vector<Eigen::Vector3f> points;  ///< of the hand, model space
  };
  using Limbs = std::array<Limb, 2>;  ///< [side]

  /// Angles of the left arm (the right's are the same in the mirror) for a wrist at a place of the sign table.
  WristAngles angles_at(const Eigen::Vector3f& place, const Eigen::Vector3f& palm, const Eigen::Vector3f& fingers,
                        float swivel) const;
  WristAngles angles_at(const Eigen::Vector3f& place, const Eigen::Vector3f& palm,
                        const Eigen::Vector3f& fingers) const;
  /// What an arm is like at an end of a stretch of the plan, without what is special about a token. `which` is 0 where
  /// the stroke begins and 1 where it ends; without a sign a Rest.
  const WristAngles& held(const HandPlan::End& end, Side side);
  const WristAngles& held(const SignShape* sign, Side side, int which);
  WristAngles find_held(const SignShape* sign, Side side, int which);
  WristAngles angles_of_end(const HandPlan::End& end, Side side);
  WristAngles angles_in(const HandPlan::Piece& piece, Side side, double frame);
  HandAngles fingers_in(const HandPlan::Piece& piece, Side side, double frame) const;
  /// The planned wrist without its full stops, model space.
  Eigen::Vector3f flowing(Side side, double frame) const;

  PosedArm pose_arm(Side side, const Eigen::Vector3f& wrist, const WristAngles& angles, const Trunk& trunk) const;
  std::vector<Eigen::Vector3f> hand_points(const ArmPose& arm, const FingerRotations& fingers, Side side) const;
  void pose_limb(Limb& limb, Side side, const Trunk& trunk) const;
  Limb planned_limb(Side side, double frame, const Trunk& trunk);
  void give_way(Limbs& limbs, const Trunk& trunk) const;
  void stay_outside(Limb& limb, Side side, const Trunk& trunk) const;
  void write_limb(const Limb& limb, Side side, MutablePoseView pose) const;

  const Signer& signer_;
  const HandPlan& plan_;
  double fps_;
  ArmUnrest unrest_[2];  ///< [side]
  ArmSizes sizes_{};
  Eigen::Vector3f shoulder_;                                             ///< the left one in the rest pose
  std::map<std::tuple<const SignShape*, Side, int>, WristAngles> held_;  ///< found once: each takes a search
  std::array<std::vector<Eigen::Vector3f>, 2> given_way_;                ///< [side][frame], metres, as the left arm
};

}  // namespace signweave::demo
