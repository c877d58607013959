#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <span>

#include "signweave/transition/method.h"

/// The inner loops of curves. Values are stored contiguously over joints, [x y z w][joint], so that compilers can
/// vectorize the loops. Internal to this module.
namespace signweave::curve_loops {

/// Number of joints computed at a time; joint counts are padded to a multiple of it.
inline constexpr std::size_t kLanes = 8;

/// Replaces `last`, [x y z w][count], by the rotations of some joints in a frame, each in the hemisphere of its
/// previous value.
void follow(const Eigen::Quaternionf* pose, const std::size_t* joints, std::size_t count, float* last) noexcept;

/// Writes rotations `q` as rotation vectors relative to `middles`, both [x y z w][count], to `out`, [x y z][width]. See
/// rotation_vector.
void see_rotations(const float* q, const float* middles, std::size_t count, std::size_t width, float* out) noexcept;

/// Updates `farthest`, [count], with the maximum squared length of each joint's vectors in `seen`, [sample][x y
/// z][width].
void see_farthest(std::span<const float> seen, std::size_t count, std::size_t width, float* farthest) noexcept;

/// Writes factor · Σ weights[sample] · (seen[sample] − seen[0]), over all samples except the first, to `out`, [width].
void add_differences(std::span<const float> weights, const float* seen, std::size_t width, float factor,
                     float* out) noexcept;

/// Σ row[term] · vectors[term], [term][stride], written to `out`, [width].
void add_up(std::span<const float> row, const float* vectors, std::size_t stride, std::size_t width,
            float* out) noexcept;

/// The inputs of a frame's rotations.
struct Turns {
  const float* vectors;         ///< [term][x y z][width]: rotation vectors relative to the middles
  const JointReaches& reaches;  ///< how far each joint may turn from its middle
  const float* middles;         ///< [x y z w][count]
  std::size_t count;            ///< of joints
  std::size_t width;
};
/// Σ row[term] · vectors[term], limited to the joints' reaches, written to `q`, [x y z w][count], as rotations relative
/// to their middles. See rotation_of.
void make_turns(std::span<const float> row, const Turns& turns, float* q) noexcept;

}  // namespace signweave::curve_loops
