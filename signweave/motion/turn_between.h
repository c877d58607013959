#pragma once

#include <Eigen/Geometry>

namespace signweave {

/// The smallest turn that takes one direction to another; neither may be zero. Where they are opposite, half a turn
/// about an axis at a right angle to both. Out of line, because Eigen finds that axis by a singular value
/// decomposition, which takes long to compile.
Eigen::Quaternionf turn_between(const Eigen::Vector3f& from, const Eigen::Vector3f& to) noexcept;

}  // namespace signweave
