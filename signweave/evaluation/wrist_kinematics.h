#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "signweave/evaluation/path_measures.h"

namespace signweave {

/// Kinematics of a wrist over a gap; defined in docs/evaluation.md.
struct WristKinematics {
  bool moves = false;     ///< farther than kStill, on a path long enough for a fit; otherwise the other members are 0
  double length = 0;      ///< metres, from border to border along the path
  double chord = 0;       ///< metres, straight from border to border
  double peak_speed = 0;  ///< metres a second
  double peak_time = 0;   ///< share of the gap, [0, 1]
  double onset = 0;       ///< share of the gap at which a tenth of the peak speed is reached
  double jerk = 0;        ///< log-dimensionless
  double arc_length = 0;  ///< spectral
  double velocity_jump = 0;      ///< metres; the largest second difference at each seam, summed
  double acceleration_jump = 0;  ///< metres; the same for third differences
};

/// Measures wrists. Reusable, so that a loop over gaps does not allocate.
class WristMeter {
 public:
  explicit WristMeter(FrameRate rate) : rate_(rate), fit_(rate) {}

  /// Measures a path with captured points on both sides of the gap: `left` is the index of the left border, `count` the
  /// number of points in the gap.
  WristKinematics measure(std::span<const Eigen::Vector3f> path, std::int64_t left, std::int64_t count);

 private:
  FrameRate rate_;
  PathFit fit_;
  std::vector<double> speeds_;
  std::vector<double> squared_jerks_;
};

/// A wrist that moves at most this far counts as still: it has no peak speed and no smoothness. Metres. (ours)
inline constexpr double kStill = 0.01;

}  // namespace signweave
