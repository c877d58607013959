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
  float ground = 0;          ///< y of the floor on which the source stands, metres
  bool face_joints = false;  ///< jaw and eyes turn as the source's joints do; else morph targets move them
  bool collar_share = true;  ///< a collar bone that the source lacks takes a share of the arm's turn; see collars_move
  bool place_hands = true;   ///< hands come to the source's places by inverse kinematics; else bones alone tell
};

/// Puts poses of one skeleton onto a character (docs/retargeting.md). Belongs to one thread; after construction
/// nothing is allocated.
/// More than fifteen members: a part or a measure of the two bodies each.
class Retargeter {
 public:
  /// `signer` says which joint of the source is what and how large its body is: signer_body of a whole motion, since an
  /// offset tells no width where joints have spaces of their own. Source, signer and character are copied as needed
  /// or, the character, must outlive it.
  Retargeter(const Skeleton& source, const SignerModel& signer, const Character& character,
             const RetargetOptions& options = {});
  Retargeter(const Retargeter&) = delete;
  Retargeter& operator=(const Retargeter&) = delete;

  /// `out` has the counts of the character's skeleton. Numbers that are none in the source give the character's rest.
  void pose(PoseView source, MutablePoseView out) noexcept;

  /// Metres of the character's signing space for one of the source's: the ratio of shoulder widths, as far as the ratio
  /// of arm lengths lets it be.
  float unit_ratio() const noexcept { return unit_ratio_; }
  /// What drives the character's joints.
  const Drives& drives() const noexcept { return drives_; }

  /// What is missing or approximate for this source: a line each. Such parts stay at rest.
  const std::vector<Notice>& notices() const noexcept { return notices_; }

 private:
  void turn_joints() noexcept;
  void put_root() noexcept;
  void lay_legs() noexcept;
  void lay_arms() noexcept;
  void rest(MutablePoseView out) const noexcept;
  static float lowest_ankle(const RigMap& rig, const ModelPose& pose) noexcept;

  Skeleton source_;
  SignerModel signer_;
  const Character* character_;
  RetargetOptions options_;
  RigAxes source_axes_;
  RigAxes axes_;
  Drives drives_;
  std::vector<bool> loose_;  ///< [the character's joint] stands against its parent as it always does
  std::vector<Notice> notices_;
  std::array<std::optional<CharacterCollar>, 2> collars_;  ///< those that take a share
  std::array<std::optional<CharacterLeg>, 2> legs_;        ///< where the source has them, too
  std::array<std::optional<CharacterArm>, 2> arms_;
  std::array<std::optional<CharacterFingers>, 2> fingers_;
  float scale_ = 1;                       ///< of the character's legs beside the source's
  float hand_scale_ = 1;                  ///< of its hands
  float unit_ratio_ = 1;                  ///< of its signing space
  float ankle_ = 0;                       ///< height at rest, metres
  float source_ankle_ = 0;                ///< the source's
  std::optional<HeadSpace> head_;         ///< in the space of the character's head joint
  std::optional<HeadSpace> source_head_;  ///< in the space of the source's head joint
  BodySurface surface_;
  SignerSpace space_;  ///< of the pose at hand
  ModelPose from_;
  ModelPose to_;
};

/// A whole motion on a character, at the same rate. Tracks pass as they are; jaw and eyes turn by joints where the
/// motion has no tracks; collar bones take a share where the source's do not move. The floor is where the lowest ankle
/// mostly is. Notices are those of the retargeter.
struct Retargeted {
  Motion motion;
  std::vector<Notice> notices;
};
Retargeted retarget(const Motion& motion, const SignerModel& signer, const Character& character);
/// The same with options, such as those of a whole of which the motion is a part: a part then comes out as in the
/// whole, to the bit.
Retargeted retarget(const Motion& motion, const SignerModel& signer, const Character& character,
                    const RetargetOptions& options);

/// What a motion, or frames spread over it, tells of how it is to be put onto a character: where the floor is, and
/// whether collar bones go along by themselves.
RetargetOptions options_for(const Motion& motion, const SignerModel& signer, const Character& character);

/// Whether the collar bones turn against the chest at all (more than 2°): else a character's take a share of the arm's
/// turn, since shoulders that stay behind look broad.
bool collars_move(const Motion& motion, const RigMap& rig);

/// y of the floor on which a motion stands, metres, told from the ankles; 0 without legs.
float ground_of(const Motion& motion, const RigMap& rig);

}  // namespace signweave
