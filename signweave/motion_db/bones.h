#pragma once

#include <vector>

#include "signweave/motion/skeleton.h"

/// Internal to this module: how far each joint of a skeleton moves others.
namespace signweave::motion_db {

/// Properties of a skeleton's bones.
struct Bones {
  std::vector<float> rotation_weight;          ///< [joint]: the step at scale 1 m
  std::vector<float> translation_weight;       ///< [joint]
  std::vector<Eigen::Vector3f> middle;         ///< [joint]: centre of its children and tips, in its space; else 0
  std::vector<bool> carries;                   ///< [joint]: rotating it moves a joint or tip
  std::vector<std::vector<JointIndex>> below;  ///< [joint]: itself and its descendants, ascending
  std::vector<std::vector<std::size_t>> tips;  ///< [joint]: its own tips

  explicit Bones(const Skeleton& skeleton);
};

}  // namespace signweave::motion_db
