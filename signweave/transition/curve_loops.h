#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <span>

#include "signweave/transition/method.h"

/// The loops over joints that curves are made of. Numbers lie one after the other over joints, [x y z w][joint], so
/// that compilers make vectors of them. Inside this module only.
namespace signweave::curve_loops {

/// The rotations of some joints in a frame, in the hemisphere of those in `last`, [x y z w][count], which they become.
void follow(const Eigen::Quaternionf* pose, const std::size_t* joints, std::size_t count, float* last) noexcept;

/// Rotations `q` as rotation vectors from `middles`, both [x y z w][count], to `out`, [x y z][width]: see
/// rotation_vector.
void see_rotations(const float* q, const float* middles, std::size_t count, std::size_t width, float* out) noexcept;

/// Σ row[term] · ways[term], [term][width], to `out`, [width].
void add_up(std::span<const float> row, const float* ways, std::size_t width, float* out) noexcept;

/// Rotation vectors `vectors`, [x y z][width], kept within how far each joint may go from the middle.
void keep_within(const JointReach* reaches, std::size_t count, std::size_t width, float* vectors) noexcept;

/// Rotation vectors, [x y z][width], as rotations from `middles` to `q`, both [x y z w][count]: see rotation_of.
void turn_by(const float* vectors, const float* middles, std::size_t count, std::size_t width, float* q) noexcept;

}  // namespace signweave::curve_loops
