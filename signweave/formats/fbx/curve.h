#pragma once

#include <cstdint>
#include <vector>

#include "signweave/core/time.h"

/// One number over time, as FBX' keys define it.
namespace signweave::fbx {

/// FBX' unit of time: this many per second.
inline constexpr std::int64_t kTicks = 46'186'158'000;

/// The interpolation between a key and the next.
struct KeyPart {
  enum class Shape : std::uint8_t { linear, constant, constant_next, cubic };
  Shape shape = Shape::linear;
  float slope = 0;          ///< of a cubic at its beginning, per second
  float next_slope = 0;     ///< at its end
  float weight = 1.0f / 3;  ///< length of the tangent at the beginning, as a fraction of the time between the keys
  float next_weight = 1.0f / 3;
};

struct Curve {
  std::vector<std::int64_t> ticks;  ///< ascending, at least one
  std::vector<float> values;        ///< [key], finite
  std::vector<KeyPart> parts;       ///< [key]; empty if all are linear
};

/// The curve at non-decreasing times; constant before the first key and after the last.
std::vector<double> sampled(const Curve& curve, const std::vector<std::int64_t>& ticks);

}  // namespace signweave::fbx
