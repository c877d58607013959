#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "signweave/motion/kinematics.h"
#include "signweave/retarget/character.h"
#include "signweave/retarget/rig_axes.h"

namespace signweave {

/// One leg of a character, laid so that the ankle comes to a place: bones of other lengths would let the foot slide.
class CharacterLeg {
 public:
  /// None where the character lacks the leg.
  static std::optional<CharacterLeg> make(const Character& character, const RigAxes& axes, Side side);

  /// Metres, of both bones.
  float length() const noexcept { return upper_length_ + lower_length_; }
  JointIndex hip() const noexcept { return upper_.front(); }

  /// Turns the joints from the hip to before the ankle, `pose` having the source's turns and the hip's place, so that
  /// the ankle is at `goal` (metres, model space) or as near as the leg reaches. The foot keeps its turn.
  void lay(const Skeleton& skeleton, const Eigen::Vector3f& goal, ModelPose& pose) const noexcept;

 private:
  std::vector<JointIndex> upper_;  ///< from the hip to before the knee
  std::vector<JointIndex> lower_;  ///< from the knee to before the ankle
  std::vector<JointIndex> below_;  ///< all below the hip, parents first
  float upper_length_ = 0;         ///< metres
  float lower_length_ = 0;
  Eigen::Vector3f upper_axis_, lower_axis_;  ///< along the bones, at rest, unit
  Eigen::Vector3f bend_;                     ///< to which the knee bends the shin, at rest, unit
};

}  // namespace signweave
