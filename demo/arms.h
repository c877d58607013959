#pragma once

#include <array>
#include <functional>
#include <map>
#include <tuple>
#include <vector>

#include "demo/arm.h"
#include "demo/keep_out.h"
#include "demo/plan.h"
#include "demo/signer.h"

namespace signweave::demo {

/// The trunk in one frame, to which the arms are attached.
struct Trunk {
  const ModelPose& model;             ///< valid for trunk and head
  std::array<Capsule, 2> keep_out{};  ///< of the same pose
  double breath = 0;                  ///< −1 (out) to 1
};

// The places of the body that fingertips touch, as offsets in the space of a joint, metres.
inline const Eigen::Vector3f kChinFromJaw(0, -0.018f, 0.040f);     ///< of the jaw
inline const Eigen::Vector3f kMouthFromHead(0, 0.025f, 0.107f);    ///< of the head
inline const Eigen::Vector3f kChestFromSpine2(0, 0.060f, 0.130f);  ///< of the upper chest

/// Where a hand is wanted in signer-centred space, instead of by a plan.
struct SignerHand {
  Eigen::Vector3f palm;     ///< its centre, metres from between the shoulders, signer's axes
  Eigen::Quaternionf hand;  ///< turns a hand with fingers forward and palm down; signer's axes
  float swivel = 0;         ///< of the elbow
  HandAngles fingers{};
};
/// For any side and frame.
using SignerHands = std::function<SignerHand(Side side, double frame)>;

/// From the axes of the left wrist to those in which the fingers point forward and the palm faces down.
Eigen::Quaternionf hand_from_wrist();

/// Idle motion of one arm: a slow drift of about a millimetre, and a finer, faster tremor.
struct ArmIdleMotion {
  explicit ArmIdleMotion(Random& random);
  Wander place[3], tremor[3], twist, flexion, radial, swivel, fingers[kFingers];
};

/// Poses both arms and hands of one recording after the plan, with idle motion. Call `look_ahead` for every frame in
/// order first, then `yield_smoothly`, then `fill`.
class Arms {
 public:
  /// Borrows signer and plan.
  Arms(const Signer& signer, const HandPlan& plan, double frames_per_second, Random& random);
  /// The hands go where `hands` wants them, in the space of the shoulders as they are; `plan` only says what they
  /// touch. Without idle motion.
  Arms(const Signer& signer, const HandPlan& plan, SignerHands hands, double frames_per_second, Random& random);

  /// Finds where the hands would collide with each other, the head or the trunk in the next frame.
  void look_ahead(std::int64_t frame, const Trunk& trunk);
  /// Smooths the avoidance over time, so that the hands react before a collision.
  void yield_smoothly();
  /// Writes the joints from the clavicles to the fingertips.
  void fill(std::int64_t frame, const Trunk& trunk, MutablePoseView pose);

 private:
  struct PosedArm {
    Eigen::Vector3f shoulder;
    Eigen::Quaternionf clavicle, chest;
    ArmPose arm;
  };
  /// One arm and hand as the left one (the right is mirrored).
  struct Limb {
    Eigen::Vector3f wrist;  ///< target position
    WristAngles angles;
    FingerRotations fingers;
    PosedArm posed;
    std::vector<Eigen::Vector3f> points;  ///< of the hand, model space
  };
  using Limbs = std::array<Limb, 2>;  ///< [side]

  /// Angles of the left arm (the same for the right, mirrored) for a wrist at a position of the sign table.
  WristAngles angles_at(const Eigen::Vector3f& place, const Eigen::Vector3f& palm, const Eigen::Vector3f& fingers,
                        float swivel) const;
  WristAngles angles_at(const Eigen::Vector3f& place, const Eigen::Vector3f& palm,
                        const Eigen::Vector3f& fingers) const;
  /// The arm at an end of a piece of the plan, without variation per token. `which` is 0 for the begin of the stroke
  /// and 1 for its end; without a sign, a Rest.
  const WristAngles& held(const HandPlan::End& end, Side side);
  const WristAngles& held(const SignShape* sign, Side side, int which);
  WristAngles find_held(const SignShape* sign, Side side, int which);
  WristAngles angles_of_end(const HandPlan::End& end, Side side);
  WristAngles angles_in(const HandPlan::Piece& piece, Side side, double frame);
  HandAngles fingers_in(const HandPlan::Piece& piece, Side side, double frame) const;
  /// The planned wrist without full stops in the movement, model space.
  Eigen::Vector3f flowing(Side side, double frame) const;

  PosedArm pose_arm(Side side, const Eigen::Vector3f& wrist, const WristAngles& angles, const Trunk& trunk) const;
  std::vector<Eigen::Vector3f> hand_points(const ArmPose& arm, const FingerRotations& fingers, Side side) const;
  void pose_limb(Limb& limb, Side side, const Trunk& trunk) const;
  Limb planned_limb(Side side, double frame, const Trunk& trunk);
  Limbs planned_limbs(double frame, const Trunk& trunk);
  // Hands that are wanted in signer-centred space (arms_space.cpp).
  Limbs wanted_limbs(double frame, const Trunk& trunk) const;
  void aim_limb(Limb& limb, const SignerHand& wanted, Side side, const Eigen::Vector3f& origin, float yaw) const;
  void yield(Limbs& limbs, const Trunk& trunk) const;
  void stay_outside(Limb& limb, Side side, const Trunk& trunk) const;
  void write_limb(const Limb& limb, Side side, MutablePoseView pose) const;
  // Hands that are kept still, and fingertips that touch something (arms_channels.cpp).
  void remember_still(const Limbs& limbs, std::int64_t frame);
  void keep_still(std::int64_t frame, Side side, MutablePoseView pose) const;
  void add_unrest(Side side, double weight, double seconds, MutablePoseView pose) const;
  void touch(Limb& limb, std::int64_t frame, Side side, const Trunk& trunk, PoseView pose) const;
  Eigen::Vector3f touched_place(const HandPlan::Touch& touch, const Eigen::Vector3f& tip, const Trunk& trunk,
                                PoseView pose) const;
  std::vector<JointIndex> limb_joints(Side side) const;

  const Signer& signer_;
  const HandPlan& plan_;
  SignerHands hands_;  ///< empty: as planned
  double fps_;
  ArmIdleMotion idle_motion_[2];  ///< [side]
  ArmSizes sizes_{};
  Eigen::Vector3f shoulder_;                                             ///< left shoulder in the rest pose
  std::map<std::tuple<const SignShape*, Side, int>, WristAngles> held_;  ///< cache: each entry takes a search
  std::array<std::vector<Eigen::Vector3f>, 2> yielded_;                  ///< [side][frame], metres, as the left arm
  /// [side][HandPlan::still][limb joint]: local rotations of the hands that are kept still.
  std::array<std::vector<std::vector<Eigen::Quaternionf>>, 2> still_;
};

}  // namespace signweave::demo
