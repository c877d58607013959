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

/// The fingers of one hand of a character: keeps joints within their limits, and brings fingertips to the thumb where
/// the source's meet it.
class CharacterFingers {
 public:
  CharacterFingers(const Character& character, const RigMap& source_rig, Side side);

  /// `pose` has the wrist's turn and place, and the turns that the source told. The fingers' turns are bounded and
  /// their places set. `drives` says which joints are driven: the others go with their parents.
  void lay(const Skeleton& skeleton, const Drives& drives, ModelPose& pose) const noexcept;

  /// Turns fingers and thumb at their first joints so that each tip is as far from the thumb's as in the source, hand
  /// for hand, the more the nearer they are there. Then the same limits.
  void pinch(const Skeleton& skeleton, const ModelPose& source, const Eigen::Quaternionf& target_from_source,
             float scale, ModelPose& pose) const noexcept;

  /// Points of the hand: its own and the source's, one for one. There are `count` of them.
  struct Point {
    PartPlace own;
    PartPlace source;
  };
  static constexpr std::size_t kMostPoints = 3 * kFingers.size();
  std::size_t count() const noexcept { return count_; }
  const Point& point(std::size_t i) const noexcept { return points_[i]; }

 private:
  void bound(const CharacterFinger& finger, std::size_t i, const Skeleton& skeleton, ModelPose& pose) const noexcept;
  void place(const CharacterFinger& finger, const Skeleton& skeleton, ModelPose& pose) const noexcept;

  std::array<CharacterFinger, kFingers.size()> fingers_;
  std::array<std::optional<Point>, kFingers.size()> tips_;
  std::array<Point, kMostPoints> points_;
  std::size_t count_ = 0;
  std::vector<JointIndex> below_;          ///< the hand's joints beyond the wrist, ascending
  std::vector<Eigen::Quaternionf> still_;  ///< [joint] as the character has them where nothing drives
};

}  // namespace signweave
