#pragma once

#include <array>
#include <cstddef>

#include "signweave/features/contact.h"

namespace signweave {

/// Up to kMost capsules, each number in an array of its own, so that one is held against all of them at once. Reusable.
struct CapsuleRow {
  static constexpr std::size_t kMost = 24;
  using Numbers = std::array<float, kMost>;

  alignas(32) Numbers from_x{}, from_y{}, from_z{};  ///< metres
  Numbers along_x{}, along_y{}, along_z{};           ///< to the end
  Numbers square{};                                  ///< of the length
  Numbers radius{};                                  ///< below 0 where there is no capsule
  std::size_t count = 0;

  /// There must be room.
  void add(const Capsule& capsule) noexcept;
  void clear() noexcept;
  Capsule operator[](std::size_t i) const noexcept;
};

/// What `clearance` gives for one capsule and each of a row, from number `begin` on, to `out`, [number of the row].
/// What lies before `begin` or beyond the last one may be written to as well.
void clearances(const Capsule& one, const CapsuleRow& row, std::size_t begin, CapsuleRow::Numbers& out) noexcept;

/// The row after a rotation and a shift.
CapsuleRow moved(const CapsuleRow& row, const Eigen::Matrix3f& turn, const Eigen::Vector3f& shift) noexcept;

}  // namespace signweave
