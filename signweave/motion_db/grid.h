#pragma once

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
#include <cstdint>

/// Internal to this module: the grids on which compact packets store numbers, and how a quaternion is restored from
/// three numbers. This code determines stored bits: it must never change.
namespace signweave::motion_db {

/// The number of frames that share a grid, a dropped component and a base, counted from the motion's frame 0: a packet
/// that begins or ends within a run contains part of it.
inline constexpr std::int64_t kRunFrames = 16;

/// Steps start at 2^-30 (level 0), four per octave: 2^e · {1, 1.25, 1.5, 1.75}.
inline constexpr int kMostLevel = 255;
/// The coarsest level that a quantiser uses: a step of 1/8.
inline constexpr int kCoarsestLevel = 108;

inline std::uint32_t step_bits(std::uint32_t level) noexcept {
  return (level + 388u) << 21;
}
/// The step of a level. It has three significant bits, so its products with whole numbers below 2^21 are exact.
inline float step_of(int level) noexcept {
  return std::bit_cast<float>(step_bits(static_cast<std::uint32_t>(level)));
}
/// The coarsest level in [0, kCoarsestLevel] whose step is at most `step`; 0 if there is none.
inline int level_below(float step) noexcept {
  if (!(step > step_of(0))) return 0;
  if (step >= step_of(kCoarsestLevel)) return kCoarsestLevel;
  return static_cast<int>(std::bit_cast<std::uint32_t>(step) >> 21) - 388;
}

/// How a rotation's fourth number is restored: which one was dropped (0 to 3: x, y, z, w), and whether it is negative.
struct Dropped {
  int component = 3;
  bool negative = false;
  friend bool operator==(Dropped, Dropped) = default;
};

/// The component that the i-th stored number holds: component i, but w replaces the dropped one.
inline int kept_component(Dropped dropped, int i) noexcept {
  return i == dropped.component ? 3 : i;
}

/// The rotation with the given three stored numbers. The order of operations is part of the format.
inline Eigen::Quaternionf restored(Dropped dropped, float a, float b, float c) noexcept {
  const float rest = 1.0f - (a * a + b * b + c * c);
  const float root = std::sqrt(rest > 0.0f ? rest : 0.0f);
  Eigen::Vector4f q(a, b, c, 0.0f);
  if (dropped.component < 3) q[3] = q[dropped.component];
  q[dropped.component] = dropped.negative ? -root : root;
  return Eigen::Quaternionf(q);
}

}  // namespace signweave::motion_db
