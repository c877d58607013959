#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "signweave/motion/kinematics.h"
#include "signweave/retarget/character.h"
#include "signweave/retarget/drives.h"
#include "signweave/retarget/rig_axes.h"

namespace signweave {

/// Returns the twist of a rotation about an axis (unit vector): `turn` = swing · twist. Radians in [−π, π].
float twist_about(const Eigen::Quaternionf& turn, const Eigen::Vector3f& axis) noexcept;

/// The directions of a chain of two bones, model space.
struct TwoBones {
  Eigen::Vector3f upper;  ///< unit, from the shoulder to the elbow
  Eigen::Vector3f lower;  ///< unit, from the elbow to the wrist
};
/// Bends two bones so that they end at `goal`, relative to the shoulder (metres), or as near as they reach; the elbow
/// stays in its plane. `bend` is the direction in which a straight arm bends.
TwoBones reach(const TwoBones& bones, float upper_length, float lower_length, const Eigen::Vector3f& goal,
               const Eigen::Vector3f& bend) noexcept;

/// One arm of a character. Rotates all joints from the shoulder to the wrist.
class CharacterArm {
 public:
  /// Returns nullopt if the character lacks the arm.
  static std::optional<CharacterArm> make(const Character& character, const RigAxes& axes, Side side);

  JointIndex shoulder() const noexcept { return upper_.front(); }
  JointIndex wrist() const noexcept { return wrist_; }
  float length() const noexcept { return upper_length_ + lower_length_; }

  /// Which parts of the source's arm have joints that carry their own twist.
  struct Twist {
    bool upper = false;  ///< true: the source's upper arm does, so its rotations are kept
    bool lower = false;
  };
  /// Poses the arm so that the wrist reaches `goal` (metres, model space), given the rotations of the source's arm and
  /// hand; without a goal, along the source's bones. On entry `pose` contains the shoulder's position. Changes the
  /// rotations from the shoulder to before the wrist, and the positions from there to the wrist. The wrist's own
  /// rotation is unchanged.
  void solve(const Skeleton& skeleton, const std::optional<Eigen::Vector3f>& goal, Twist twist, ModelPose& pose) const;

 private:
  void update_positions(const Skeleton& skeleton, ModelPose& pose) const;

  JointIndex parent_ = kNoJoint;   ///< parent of the shoulder
  std::vector<JointIndex> upper_;  ///< from the shoulder to before the elbow
  std::vector<JointIndex> lower_;  ///< from the elbow to before the wrist
  JointIndex wrist_ = kNoJoint;
  float upper_length_ = 0;  ///< metres
  float lower_length_ = 0;
  Eigen::Vector3f upper_axis_, lower_axis_;  ///< along the bones, at rest, unit vectors
  Eigen::Vector3f upper_bend_, lower_bend_;  ///< direction in which the elbow bends, at rest, unit vectors
};

}  // namespace signweave
