#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <span>

#include "signweave/transition/method.h"

/// The loops over joints that curves are made of. Numbers lie one after the other over joints, [x y z w][joint], so
/// that compilers make vectors of them. Inside this module only.
namespace signweave::curve_loops {

/// Joints are computed so many at a time: their number is a multiple of it.
inline constexpr std::size_t kLanes = 8;

/// The rotations of some joints in a frame, in the hemisphere of those in `last`, [x y z w][count], which they become.
void follow(const Eigen::Quaternionf* pose, const std::size_t* joints, std::size_t count, float* last) noexcept;

/// Rotations `q` as rotation vectors from `middles`, both [x y z w][count], to `out`, [x y z][width]: see
/// rotation_vector.
void see_rotations(const float* q, const float* middles, std::size_t count, std::size_t width, float* out) noexcept;

/// The squared length of the longest of each joint's vectors, `seen` [sample][x y z][width], and of `farthest`, to
/// `farthest`, [count].
void see_farthest(std::span<const float> seen, std::size_t count, std::size_t width, float* farthest) noexcept;

/// factor · Σ weights[sample] · (seen[sample] − seen[0]) over the samples but the first, to `out`, [width].
void add_differences(std::span<const float> weights, const float* seen, std::size_t width, float factor,
                     float* out) noexcept;

/// Σ row[term] · ways[term], [term][stride], to `out`, [width].
void add_up(std::span<const float> row, const float* ways, std::size_t stride, std::size_t width, float* out) noexcept;

/// What a frame's rotations are made of.
struct Turns {
  const float* ways;            ///< [term][x y z][width]: rotation vectors from the middles
  const JointReaches& reaches;  ///< how far each joint may go from its middle
  const float* middles;         ///< [x y z w][count]
  std::size_t count;            ///< of joints
  std::size_t width;
};
/// Σ row[term] · ways[term], kept within the joints' reaches, as rotations from their middles to `q`, [x y z w][count]:
/// see rotation_of.
void make_turns(std::span<const float> row, const Turns& turns, float* q) noexcept;

}  // namespace signweave::curve_loops
