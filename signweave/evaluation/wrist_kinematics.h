#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "signweave/evaluation/path_measures.h"

namespace signweave {

/// How a wrist goes over a gap. docs/evaluation.md defines each.
struct WristKinematics {
  bool moves = false;            ///< farther than kStill, on a path long enough to be fitted; else the rest is 0
  double length = 0;             ///< metres, from border to border along the path
  double chord = 0;              ///< metres, from border to border straight
  double peak_speed = 0;         ///< metres a second
  double peak_time = 0;          ///< share of the gap, [0, 1]
  double onset = 0;              ///< share of the gap at which a tenth of the peak speed is reached
  double jerk = 0;               ///< log-dimensionless
  double arc_length = 0;         ///< spectral
  double velocity_jump = 0;      ///< metres; second difference over the seams, the largest of each, added
  double acceleration_jump = 0;  ///< metres; likewise of third differences
};

/// Measures wrists. Reusable, so that a loop over gaps allocates nothing.
class WristMeter {
 public:
  explicit WristMeter(FrameRate rate) : rate_(rate), fit_(rate) {}

  /// Of a path with captured points on both sides of the gap: `left` is the left border's place in it, `count` the
  /// points of the gap.
  WristKinematics measure(std::span<const Eigen::Vector3f> path, std::int64_t left, std::int64_t count);

 private:
  FrameRate rate_;
  PathFit fit_;
  std::vector<double> speeds_;
  std::vector<double> squared_jerks_;
};

/// A wrist that goes no farther than this keeps still: it has no peak speed and no smoothness. Metres. (ours)
inline constexpr double kStill = 0.01;

}  // namespace signweave
