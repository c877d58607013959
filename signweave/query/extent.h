#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "signweave/features/point_track.h"
#include "signweave/rig/signer_space.h"

namespace signweave {

// The extremes of a point over some frames and the zones it is in at any of them: the values behind `max(…)`, `min(…)`,
// `any(…)` and `enters(…)`.

/// Minimum and maximum of some numbers.
struct Extremes {
  float least = std::numeric_limits<float>::infinity();
  float most = -std::numeric_limits<float>::infinity();
  bool empty() const noexcept { return least > most; }
  void add(float value) noexcept {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  void add(const Extremes& other) noexcept {
    least = std::min(least, other.least);
    most = std::max(most, other.most);
  }
};

// Sets of named zones and directions as bits; each set is below 2^24, so that a float holds it exactly.
constexpr std::uint32_t bit_of(Height height) noexcept {
  return 1U << static_cast<unsigned>(height);
}
constexpr std::uint32_t bit_of(Across across) noexcept {
  return 1U << (8 + static_cast<unsigned>(across));
}
constexpr std::uint32_t bit_of(Reach reach) noexcept {
  return 1U << (11 + static_cast<unsigned>(reach));
}
inline constexpr std::uint32_t kHeightBits = 0x00FF;
inline constexpr std::uint32_t kAcrossBits = 0x0700;
inline constexpr std::uint32_t kReachBits = 0x1800;
constexpr std::uint32_t bits_of(Zone zone) noexcept {
  return bit_of(zone.height) | bit_of(zone.across) | bit_of(zone.reach);
}
/// Directions of the palm and the fingers in one set; the masks exclude Facing::unknown.
constexpr std::uint32_t palm_bit(Facing facing) noexcept {
  return 1U << static_cast<unsigned>(facing);
}
constexpr std::uint32_t fingers_bit(Facing facing) noexcept {
  return 1U << (8 + static_cast<unsigned>(facing));
}
inline constexpr std::uint32_t kPalmBits = 0x007E;
inline constexpr std::uint32_t kFingersBits = 0x7E00;

/// What a point reaches over some frames. Lengths in shoulder widths, signer-centred.
struct Extent {
  Extremes x;
  Extremes height;
  Extremes forward;
  Extremes speed;           ///< metres per second
  Extremes acceleration;    ///< metres per second squared
  Extremes openness;        ///< empty for a point without fingers
  std::uint32_t in = 0;     ///< zones it is in at some frame, as `bits_of`
  std::uint32_t into = 0;   ///< zones it is in at some frame but not at the previous one
  std::uint32_t faces = 0;  ///< directions of palm and fingers at some frame
};

/// Accumulates an `Extent` frame by frame.
class ExtentSum {
 public:
  explicit ExtentSum(const SignerBody& body) noexcept : body_(&body) {}
  /// Adds the next frame of a span.
  void add(const PointFrame& frame) noexcept {
    const std::uint32_t bits = include(frame);
    if (before_ != 0) extent_.into |= bits & ~before_;
    before_ = bits;
  }
  /// Adds a single frame without entering any zone. Returns its zones.
  std::uint32_t include(const PointFrame& frame) noexcept;
  const Extent& extent() const noexcept { return extent_; }
  /// Continues from the result of another sum.
  void start_from(const Extent& extent) noexcept { extent_ = extent; }

 private:
  const SignerBody* body_;
  Extent extent_;
  std::uint32_t before_ = 0;  ///< zones of the last frame; 0 before the first
};

/// The extent of two spans together; no zone is entered between them.
Extent join(const Extent& a, const Extent& b) noexcept;

}  // namespace signweave
