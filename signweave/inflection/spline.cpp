#include "signweave/inflection/spline.h"

#include <algorithm>

namespace signweave {
namespace {

PathPoint sum(const PathPoint& a, float of_a, const PathPoint& b, float of_b) {
  return {.shift = of_a * a.shift + of_b * b.shift,
          .turn = of_a * a.turn + of_b * b.turn,
          .swivel = of_a * a.swivel + of_b * b.swivel};
}

}  // namespace

PathSpline::PathSpline(std::span<const PathPoint> points)
    : points_(points.begin(), points.end()), curvatures_(points.size()) {
  if (points.size() < 3) return;
  // The tridiagonal system c[i-1] + 4 c[i] + c[i+1] = 6 (p[i-1] - 2 p[i] + p[i+1]), c = 0 at both ends.
  std::vector<float> factors(points.size(), 0.0f);
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const PathPoint bend = sum(sum(points_[i - 1], 6, points_[i + 1], 6), 1, points_[i], -12);
    const float pivot = 4 - factors[i - 1];
    factors[i] = 1 / pivot;
    curvatures_[i] = sum(bend, 1 / pivot, curvatures_[i - 1], -1 / pivot);
  }
  for (std::size_t i = points.size() - 2; i > 0; --i) {
    curvatures_[i] = sum(curvatures_[i], 1, curvatures_[i + 1], -factors[i]);
  }
}

PathPoint PathSpline::at(float time) const noexcept {
  if (points_.empty()) return {};
  if (points_.size() == 1) return points_.front();
  const float place = std::clamp(time, 0.0f, 1.0f) * static_cast<float>(points_.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), points_.size() - 2);
  const float b = place - static_cast<float>(i);
  const float a = 1 - b;
  return sum(sum(points_[i], a, points_[i + 1], b), 1,
             sum(curvatures_[i], (a * a * a - a) / 6, curvatures_[i + 1], (b * b * b - b) / 6), 1);
}

}  // namespace signweave
