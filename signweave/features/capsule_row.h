#pragma once

#include <array>
#include <cstddef>

#include "signweave/features/contact.h"

namespace signweave {

/// Up to kMost capsules stored as a structure of arrays, so that one capsule is tested against all of them at once.
/// Reusable.
struct CapsuleRow {
  static constexpr std::size_t kMost = 24;
  using Numbers = std::array<float, kMost>;

  alignas(32) Numbers from_x{}, from_y{}, from_z{};  ///< start points, metres
  Numbers along_x{}, along_y{}, along_z{};           ///< from start to end, metres
  Numbers square{};                                  ///< squared length
  Numbers radius{};                                  ///< metres; negative for an unused slot
  std::size_t count = 0;

  /// Precondition: count < kMost.
  void add(const Capsule& capsule) noexcept;
  void clear() noexcept;
  Capsule operator[](std::size_t i) const noexcept;
};

/// Writes `clearance` of `one` against each capsule of the row, from index `begin` on, to `out` [index in the row].
/// Elements before `begin` or past the last capsule may be overwritten too.
void clearances(const Capsule& one, const CapsuleRow& row, std::size_t begin, CapsuleRow::Numbers& out) noexcept;

/// Returns the row after a rotation and a translation.
CapsuleRow moved(const CapsuleRow& row, const Eigen::Matrix3f& turn, const Eigen::Vector3f& shift) noexcept;

}  // namespace signweave
