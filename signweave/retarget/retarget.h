#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/features/hand_motion.h"
#include "signweave/motion/kinematics.h"
#include "signweave/motion/motion.h"
#include "signweave/retarget/arm.h"
#include "signweave/retarget/body_surface.h"
#include "signweave/retarget/character.h"
#include "signweave/retarget/collar.h"
#include "signweave/retarget/drives.h"
#include "signweave/retarget/fingers.h"
#include "signweave/retarget/hand_places.h"
#include "signweave/retarget/leg.h"
#include "signweave/retarget/rig_axes.h"

namespace signweave {

struct RetargetOptions {
  float ground = 0;          ///< y of the source's floor, metres
  bool face_joints = false;  ///< jaw and eyes rotate with the source's joints; else morph targets move them
  bool collar_share = true;  ///< a clavicle that the source lacks takes a share of the arm's rotation; see collars_move
  bool place_hands =
      true;  ///< hands reach the source's positions by inverse kinematics; else only the bones' directions count
};

/// Retargets poses of one skeleton to a character (docs/retargeting.md). Belongs to one thread; allocates nothing after
/// construction. More than fifteen members: each is a part or a measure of the two bodies.
class Retargeter {
 public:
  /// `signer` maps the source's joints and gives the body's size: use signer_body of a whole motion, because offsets do
  /// not determine widths if joints have their own spaces. Source and signer are copied; the character must outlive
  /// this object.
  Retargeter(const Skeleton& source, const SignerModel& signer, const Character& character,
             const RetargetOptions& options = {});
  Retargeter(const Retargeter&) = delete;
  Retargeter& operator=(const Retargeter&) = delete;

  /// `out` has the counts of the character's skeleton. Non-finite input gives the character's rest pose.
  void pose(PoseView source, MutablePoseView out) noexcept;

  /// Returns metres of the character's signing space per metre of the source's: the ratio of shoulder widths, limited
  /// by the ratio of arm lengths.
  float unit_ratio() const noexcept { return unit_ratio_; }
  /// Returns which source joints drive the character's joints.
  const Drives& drives() const noexcept { return drives_; }

  /// Returns one line for each missing or approximate feature of this source. Missing parts stay at rest.
  const std::vector<Notice>& notices() const noexcept { return notices_; }

 private:
  void turn_joints() noexcept;
  void put_root() noexcept;
  void solve_legs() noexcept;
  void solve_arms() noexcept;
  void rest(MutablePoseView out) const noexcept;
  static float lowest_ankle(const RigMap& rig, const ModelPose& pose) noexcept;

  Skeleton source_;
  SignerModel signer_;
  const Character* character_;
  RetargetOptions options_;
  RigAxes source_axes_;
  RigAxes axes_;
  Drives drives_;
  std::vector<bool> loose_;  ///< [the character's joint] keeps its fixed rotation relative to its parent
  std::vector<Notice> notices_;
  std::array<std::optional<CharacterCollar>, 2> collars_;  ///< those that take a share of the arm's rotation
  std::array<std::optional<CharacterLeg>, 2> legs_;        ///< present if the source has them, too
  std::array<std::optional<CharacterArm>, 2> arms_;
  std::array<std::optional<CharacterFingers>, 2> fingers_;
  float scale_ = 1;                       ///< ratio of the character's legs to the source's
  float hand_scale_ = 1;                  ///< ratio of the hands
  float unit_ratio_ = 1;                  ///< ratio of the signing spaces
  float ankle_ = 0;                       ///< ankle height at rest, metres
  float source_ankle_ = 0;                ///< the source's
  std::optional<HeadSpace> head_;         ///< in the space of the character's head joint
  std::optional<HeadSpace> source_head_;  ///< in the space of the source's head joint
  BodySurface surface_;
  SignerSpace space_;  ///< of the current pose
  ModelPose from_;
  ModelPose to_;
};

/// A motion retargeted to a character, at the same rate, with the retargeter's notices.
struct Retargeted {
  Motion motion;
  std::vector<Notice> notices;
};
/// Retargets a whole motion. Tracks are passed through; jaw and eyes rotate with joints if the motion has no tracks;
/// clavicles take a share of the arm's rotation if the source's do not move. The floor is derived from the median
/// height of the lowest ankle.
Retargeted retarget(const Motion& motion, const SignerModel& signer, const Character& character);
/// The same with given options, such as those of a longer motion that contains this one: the result is then
/// bit-identical to that part of the whole.
Retargeted retarget(const Motion& motion, const SignerModel& signer, const Character& character,
                    const RetargetOptions& options);

/// Returns the options for retargeting a motion to a character, derived from the motion or from frames distributed over
/// it: the position of the floor, and whether the source's clavicles move.
RetargetOptions options_for(const Motion& motion, const SignerModel& signer, const Character& character);

/// Returns whether the clavicles rotate relative to the chest by more than 2°. If not, a character's clavicles take a
/// share of the arm's rotation, because shoulders that do not follow look broad.
bool collars_move(const Motion& motion, const RigMap& rig);

/// Returns the median height of a motion's lowest ankle, metres, from which its floor is derived; 0 unless both feet
/// are known.
float ground_of(const Motion& motion, const RigMap& rig);

}  // namespace signweave
