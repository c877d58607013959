#pragma once

#include <algorithm>
#include <cmath>

#include "signweave/motion_db/compact_layout.h"

/// Internal to this module: unpacks four rotations at once from a compact packet, with the same results as `restored`.
namespace signweave::motion_db {

// Vector types that GCC and clang support on every machine.
using U4 = std::uint32_t __attribute__((vector_size(16)));
using I4 = std::int32_t __attribute__((vector_size(16)));
using F4 = float __attribute__((vector_size(16)));
using S4 = std::int16_t __attribute__((vector_size(8)));
using B4 = std::uint8_t __attribute__((vector_size(4)));

/// Masks of the lowest bits, in four lanes.
struct Masks {
  std::array<std::array<std::uint32_t, kLanes>, 32> of{};
  constexpr Masks() {
    for (std::uint32_t width = 0; width < 32; ++width) of[width].fill((1u << width) - 1);
  }
};
inline constexpr Masks kMasks;
[[gnu::always_inline]] inline U4 mask_of(std::uint32_t width) noexcept {
  U4 mask;
  std::memcpy(&mask, kMasks.of[width].data(), sizeof mask);
  return mask;
}

/// Returns 32 bits of every lane, starting at a bit.
[[gnu::always_inline]] inline U4 window(const std::byte* stream, std::uint64_t bit) noexcept {
  const std::byte* const word = stream + static_cast<std::size_t>(bit / 32) * 4 * kLanes;
  const auto shift = static_cast<std::uint32_t>(bit % 32);
  return loaded<U4>(word) >> shift | (loaded<U4>(word + 4 * kLanes) << 1) << (31 - shift);
}

/// Values on a grid, from whole numbers above a base.
[[gnu::always_inline]] inline F4 values_of(U4 above, U4 base, F4 step) noexcept {
  return __builtin_convertvector(reinterpret_cast<I4>(above + base), F4) * step;
}

[[gnu::always_inline]] inline F4 square_root(F4 v) noexcept {
  return F4{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
}

/// The rotations of the four joints of a group.
struct FourRotations {
  std::array<std::uint32_t, 3> widths;
  std::array<U4, 3> bases;
  F4 step;
  U4 sign;  ///< of the restored component
  I4 component;
  bool all_w;  ///< w was dropped in all four

  FourRotations(const RunView& run, const Counts& counts, std::size_t group) noexcept {
    const RotationGroup it(run, counts, group);
    widths = widths_of(it.widths);
    for (std::size_t i = 0; i < 3; ++i) {
      bases[i] = reinterpret_cast<U4>(run.wide ? loaded<I4>(it.bases + 16 * i)
                                               : __builtin_convertvector(loaded<S4>(it.bases + 8 * i), I4));
    }
    step = reinterpret_cast<F4>((__builtin_convertvector(loaded<B4>(it.levels), U4) + 388) << 21);
    const U4 form = __builtin_convertvector(loaded<B4>(it.forms), U4);
    sign = form >> 2 << 31;
    component = reinterpret_cast<I4>(form & 3);
    all_w = (loaded<std::uint32_t>(it.forms) & 0x03030303u) == 0x03030303u;
  }
  std::uint32_t bits() const noexcept { return widths[0] + widths[1] + widths[2]; }
};

/// Four quaternions, one vector per component.
struct FourQuaternions {
  F4 x, y, z, w;
};

/// Does the same as `restored`, without exchanging w and the dropped component.
[[gnu::always_inline]] inline FourQuaternions with_w_dropped(F4 a, F4 b, F4 c, U4 sign) noexcept {
  const F4 rest = 1.0f - (a * a + b * b + c * c);
  const F4 root = square_root(reinterpret_cast<F4>(reinterpret_cast<I4>(rest) & (rest > 0.0f)));
  return {a, b, c, reinterpret_cast<F4>(reinterpret_cast<U4>(root) | sign)};
}

/// Exchanges w and the dropped component in each of four quaternions.
[[gnu::always_inline]] inline FourQuaternions exchanged(const FourQuaternions& q, I4 component) noexcept {
  const I4 x = reinterpret_cast<I4>(q.x);
  const I4 y = reinterpret_cast<I4>(q.y);
  const I4 z = reinterpret_cast<I4>(q.z);
  const I4 made = reinterpret_cast<I4>(q.w);
  const I4 is_x = component == 0;
  const I4 is_y = component == 1;
  const I4 is_z = component == 2;
  const I4 w = (x & is_x) | (y & is_y) | (z & is_z) | (made & (component == 3));
  const I4 change = made ^ w;
  return {reinterpret_cast<F4>(x ^ (change & is_x)), reinterpret_cast<F4>(y ^ (change & is_y)),
          reinterpret_cast<F4>(z ^ (change & is_z)), reinterpret_cast<F4>(w)};
}

/// The positions of the quaternions of four joints in a frame, in floats. Lanes that the last group lacks get the
/// position of its first joint, which is written last.
using Places = std::array<std::size_t, kLanes>;
inline Places places_of(const std::byte* order, std::size_t group, std::size_t joints) noexcept {
  Places places;
  const std::byte* const first = order + 2 * kLanes * group;
  if ((group + 1) * kLanes <= joints) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      places[lane] = std::size_t{4} * loaded<std::uint16_t>(first + 2 * lane);
    }
    return places;
  }
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::size_t there = group * kLanes + lane < joints ? lane : 0;
    places[lane] = std::size_t{4} * loaded<std::uint16_t>(first + 2 * there);
  }
  return places;
}

[[gnu::always_inline]] inline void store(const FourQuaternions& q, const Places& places, float* out) noexcept {
  const F4 xy_low = __builtin_shufflevector(q.x, q.y, 0, 4, 1, 5);
  const F4 xy_high = __builtin_shufflevector(q.x, q.y, 2, 6, 3, 7);
  const F4 zw_low = __builtin_shufflevector(q.z, q.w, 0, 4, 1, 5);
  const F4 zw_high = __builtin_shufflevector(q.z, q.w, 2, 6, 3, 7);
  const auto put = [&](std::size_t lane, F4 one) { std::memcpy(out + places[lane], &one, sizeof one); };
  put(3, __builtin_shufflevector(xy_high, zw_high, 2, 3, 6, 7));
  put(2, __builtin_shufflevector(xy_high, zw_high, 0, 1, 4, 5));
  put(1, __builtin_shufflevector(xy_low, zw_low, 2, 3, 6, 7));
  put(0, __builtin_shufflevector(xy_low, zw_low, 0, 1, 4, 5));
}

}  // namespace signweave::motion_db
