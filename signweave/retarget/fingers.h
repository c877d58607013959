#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "signweave/features/hand_points.h"
#include "signweave/motion/kinematics.h"
#include "signweave/retarget/character.h"
#include "signweave/retarget/drives.h"

namespace signweave {

/// The fingers of one hand of a character: keeps joints within their limits, and moves fingertips to the thumb if the
/// source's touch it.
class CharacterFingers {
 public:
  CharacterFingers(const Character& character, const RigMap& source_rig, Side side);

  /// On entry `pose` contains the wrist's rotation and position, and the rotations from the source. Limits the fingers'
  /// rotations and sets their positions. `drives` specifies which joints are driven: the others follow their parents.
  void constrain(const Skeleton& skeleton, const Drives& drives, ModelPose& pose) const noexcept;

  /// Rotates fingers and thumb at their first two joints so that each tip is as far from the thumb's tip as in the
  /// source, relative to hand size; the effect is stronger the nearer the tips are there. The same limits are applied
  /// afterwards.
  void pinch(const Skeleton& skeleton, const ModelPose& source, const Eigen::Quaternionf& target_from_source,
             float scale, ModelPose& pose) const noexcept;

  /// Points of the hand, paired with the source's. There are `count` of them.
  struct Point {
    PartPlace own;
    PartPlace source;
  };
  static constexpr std::size_t kMostPoints = 3 * kFingers.size();
  std::size_t count() const noexcept { return count_; }
  const Point& point(std::size_t i) const noexcept { return points_[i]; }

 private:
  void limit(const CharacterFinger& finger, std::size_t i, const Skeleton& skeleton, ModelPose& pose) const noexcept;
  void update_positions(const CharacterFinger& finger, const Skeleton& skeleton, ModelPose& pose) const noexcept;

  std::array<CharacterFinger, kFingers.size()> fingers_;
  std::array<std::optional<Point>, kFingers.size()> tips_;
  std::array<Point, kMostPoints> points_;
  std::size_t count_ = 0;
  std::vector<JointIndex> below_;          ///< the hand's joints below the wrist, ascending
  std::vector<Eigen::Quaternionf> still_;  ///< [joint] the character's rotations of undriven joints
};

}  // namespace signweave
