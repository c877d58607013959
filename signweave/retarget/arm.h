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

/// The part of a turn about an axis (unit): `turn` = swing · twist. Radians in [−π, π].
float twist_about(const Eigen::Quaternionf& turn, const Eigen::Vector3f& axis) noexcept;

/// Where a chain of two bones goes, model space.
struct TwoBones {
  Eigen::Vector3f upper;  ///< unit, from the shoulder to the elbow
  Eigen::Vector3f lower;  ///< unit, from the elbow to the wrist
};
/// Bends two bones so that they end at `goal` from the shoulder (metres), or as near as they reach; the elbow stays in
/// the plane it is in. `bend` is the way to which a straight arm bends.
TwoBones reach(const TwoBones& bones, float upper_length, float lower_length, const Eigen::Vector3f& goal,
               const Eigen::Vector3f& bend) noexcept;

/// One arm of a character. Turns the joints from the shoulder to the wrist, whole chains at once.
class CharacterArm {
 public:
  /// None where the character lacks the arm.
  static std::optional<CharacterArm> make(const Character& character, const RigAxes& axes, Side side);

  JointIndex shoulder() const noexcept { return upper_.front(); }
  JointIndex wrist() const noexcept { return wrist_; }
  float length() const noexcept { return upper_length_ + lower_length_; }

  /// Which joints carry the twist by themselves.
  struct Twist {
    bool upper = false;  ///< the source's upper arm does: its turns stand
    bool lower = false;
  };
  /// Lays the arm so that the wrist comes to `goal` (metres, model space), given the turns that the source's arm and
  /// hand have; where there is no goal, as the source's bones lie. `pose` has the shoulder's place; its turns from the
  /// shoulder to before the wrist are changed, and the places from there to the wrist are set. The wrist's own turn
  /// stays.
  void lay(const Skeleton& skeleton, const std::optional<Eigen::Vector3f>& goal, Twist twist, ModelPose& pose) const;

 private:
  void place(const Skeleton& skeleton, ModelPose& pose) const;

  JointIndex parent_ = kNoJoint;   ///< of the shoulder
  std::vector<JointIndex> upper_;  ///< from the shoulder to before the elbow
  std::vector<JointIndex> lower_;  ///< from the elbow to before the wrist
  JointIndex wrist_ = kNoJoint;
  float upper_length_ = 0;  ///< metres
  float lower_length_ = 0;
  Eigen::Vector3f upper_axis_, lower_axis_;  ///< along the bones, at rest, unit
  Eigen::Vector3f upper_bend_, lower_bend_;  ///< to which the elbow bends, at rest, unit
};

}  // namespace signweave
