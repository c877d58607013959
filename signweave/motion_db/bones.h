#pragma once

#include <vector>

#include "signweave/motion/skeleton.h"

/// Inside this module only: how much each joint of a skeleton moves.
namespace signweave::motion_db {

/// What is known of a skeleton.
struct Bones {
  std::vector<float> rotation_weight;     ///< [joint]: step at scale 1 m
  std::vector<float> translation_weight;  ///< [joint]
  std::vector<Eigen::Vector3f> middle;  ///< [joint]: of what hangs from it directly, in its space; 0 where nothing does
  std::vector<bool> carries;            ///< [joint]: turning it moves a joint or tip
  std::vector<std::vector<JointIndex>> below;  ///< [joint]: itself and all that hang from it, ascending
  std::vector<std::vector<std::size_t>> tips;  ///< [joint]: its own tips

  explicit Bones(const Skeleton& skeleton);
};

}  // namespace signweave::motion_db
