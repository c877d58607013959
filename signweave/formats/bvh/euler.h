#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>
#include <vector>

#include "signweave/formats/bvh/bvh.h"

/// Euler angles, which are used in formats/bvh only. Internal to formats/bvh.
namespace signweave::bvh {

inline bool is_rotation(Channel channel) noexcept {
  return channel >= Channel::x_rotation;
}
/// 0, 1, 2 for x, y, z.
inline int axis_of(Channel channel) noexcept {
  return static_cast<int>(channel) % 3;
}

/// True for three positions followed by three rotations: the only root whose columns can be read rotation first.
bool has_positions_then_rotations(const std::vector<Channel>& channels) noexcept;

/// The axes of a joint's rotation channels in file order: none, or up to three different ones.
struct RotationOrder {
  std::array<int, 3> axes{};
  int count = 0;
};
RotationOrder rotation_order(std::span<const Channel> channels) noexcept;

/// Radians, one per rotation channel in file order; those past the order's count are 0.
using Angles = std::array<double, 3>;

/// Returns the angles whose rotations, applied in order, give `rotation`; if the order has fewer than three axes, those
/// that come nearest to it. If `before`, the angles of the previous frame, is null, the middle angle is within ±90°,
/// the others within ±180°, and the last is 0 at gimbal lock. Otherwise, of all angles that give the same rotation,
/// returns those nearest to `before`; at gimbal lock the free combination of first and last does not change.
Angles angles_of(const Eigen::Quaterniond& rotation, const RotationOrder& order, const Angles* before) noexcept;

/// Finds the angles of all joints, one frame after another; faster than angles_of.
class AngleFinder {
 public:
  /// `orders` is [joint].
  explicit AngleFinder(std::vector<RotationOrder> orders);

  /// The angles of the next frame's rotations, both [joint]. Valid until the next call.
  std::span<const Angles> next(std::span<const Eigen::Quaterniond> rotations) noexcept;

 private:
  std::vector<RotationOrder> orders_;
  std::vector<Angles> angles_;  ///< of the previous frame
  bool is_first_ = true;
  std::vector<double> rises_, runs_, found_;  ///< [joint][3]
};

}  // namespace signweave::bvh
