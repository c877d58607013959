#pragma once

#include <Eigen/Geometry>

namespace signweave {

/// The smallest rotation that maps one direction to another; neither may be zero. For opposite directions: half a turn
/// about an axis perpendicular to both. Not inline, because Eigen finds that axis by a singular value decomposition,
/// which takes long to compile.
Eigen::Quaternionf turn_between(const Eigen::Vector3f& from, const Eigen::Vector3f& to) noexcept;

}  // namespace signweave
