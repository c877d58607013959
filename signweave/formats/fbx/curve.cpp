#include "signweave/formats/fbx/curve.h"

#include <algorithm>
#include <cmath>

namespace signweave::fbx {
namespace {

double bezier(double p0, double p1, double p2, double p3, double u) noexcept {
  const double v = 1 - u;
  return v * v * v * p0 + 3 * v * v * u * p1 + 3 * v * u * u * p2 + u * u * u * p3;
}

/// Evaluates a cubic part of duration `seconds` at `time` in (0, 1): a Bézier curve whose inner points lie on the
/// tangents.
double cubic_at(const KeyPart& part, double from, double to, double seconds, double time) noexcept {
  const double first = std::clamp(static_cast<double>(part.weight), 1e-4, 0.9999);
  const double last = std::clamp(static_cast<double>(part.next_weight), 1e-4, 0.9999);
  // With weights of one third, time is proportional to the curve parameter.
  const bool even = std::abs(first - 1.0 / 3) < 1e-6 && std::abs(last - 1.0 / 3) < 1e-6;
  double low = even ? time : 0;
  double high = even ? time : 1;
  // Time increases along the curve, because its inner points lie between the keys, so bisection finds the parameter.
  for (int i = 0; !even && i < 52; ++i) {
    const double middle = (low + high) / 2;
    (bezier(0, first, 1 - last, 1, middle) < time ? low : high) = middle;
  }
  return bezier(from, from + static_cast<double>(part.slope) * first * seconds,
                to - static_cast<double>(part.next_slope) * last * seconds, to, (low + high) / 2);
}

double between(const Curve& curve, std::size_t key, std::int64_t tick) noexcept {
  const double from = static_cast<double>(curve.values[key]);
  const double to = static_cast<double>(curve.values[key + 1]);
  const double span = static_cast<double>(curve.ticks[key + 1] - curve.ticks[key]);
  const double time = static_cast<double>(tick - curve.ticks[key]) / span;
  const KeyPart part = curve.parts.empty() ? KeyPart{} : curve.parts[key];
  switch (part.shape) {
    case KeyPart::Shape::constant:
      return from;
    case KeyPart::Shape::constant_next:
      return time > 0 ? to : from;
    case KeyPart::Shape::cubic:
      if (time > 0) return cubic_at(part, from, to, span / static_cast<double>(kTicks), time);
      return from;
    case KeyPart::Shape::linear:
      break;
  }
  return from + (to - from) * time;
}

}  // namespace

std::vector<double> sampled(const Curve& curve, const std::vector<std::int64_t>& ticks) {
  std::vector<double> values;
  values.reserve(ticks.size());
  std::size_t key = 0;
  for (const std::int64_t tick : ticks) {
    while (key + 1 < curve.ticks.size() && curve.ticks[key + 1] <= tick) ++key;
    const bool outside = tick <= curve.ticks[key] || key + 1 == curve.ticks.size();
    values.push_back(outside ? static_cast<double>(curve.values[key]) : between(curve, key, tick));
  }
  return values;
}

}  // namespace signweave::fbx
