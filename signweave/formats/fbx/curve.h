#pragma once

#include <cstdint>
#include <vector>

#include "signweave/core/time.h"

/// One number over time, as FBX' keys tell it.
namespace signweave::fbx {

/// FBX' unit of time: so many are a second.
inline constexpr std::int64_t kTicks = 46'186'158'000;

/// What lies between a key and the next.
struct KeyPart {
  enum class Shape : std::uint8_t { linear, constant, constant_next, cubic };
  Shape shape = Shape::linear;
  float slope = 0;          ///< of a cubic where it begins, per second
  float next_slope = 0;     ///< and where it ends
  float weight = 1.0f / 3;  ///< length of the tangent where it begins, of the time between the keys
  float next_weight = 1.0f / 3;
};

struct Curve {
  std::vector<std::int64_t> ticks;  ///< ascending, at least one
  std::vector<float> values;        ///< [key], finite
  std::vector<KeyPart> parts;       ///< [key]; empty where all are linear
};

/// The curve at times that do not go back: before the first key its value, after the last its.
std::vector<double> sampled(const Curve& curve, const std::vector<std::int64_t>& ticks);

}  // namespace signweave::fbx
