#pragma once

#include <span>
#include <vector>

#include "signweave/space/stroke_change.h"

namespace signweave {

/// Natural cubic splines through the points of a path, which are at equal steps over [0, 1].
class PathSpline {
 public:
  PathSpline() = default;
  explicit PathSpline(std::span<const PathPoint> points);

  bool empty() const noexcept { return points_.empty(); }
  /// The value at a time, which is clamped to [0, 1]; all zero if empty.
  PathPoint at(float time) const noexcept;

 private:
  std::vector<PathPoint> points_;
  std::vector<PathPoint> curvatures_;  ///< second derivatives, by the step
};

}  // namespace signweave
