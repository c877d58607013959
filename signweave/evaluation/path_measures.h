#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "signweave/core/time.h"

namespace signweave {

// Measures of a single path, captured or generated. Definitions are in docs/evaluation.md.

/// Derivatives of a path, from a cubic fitted over a window around each frame (Savitzky and Golay 1964) of kPathWindow
/// and at least five frames. At the path's ends the window stays inside, so a path needs five points.
class PathFit {
 public:
  explicit PathFit(FrameRate rate);
  static constexpr std::int64_t kLeastPoints = 5;

  /// Speed at each point, metres a second; empty for a path of fewer than kLeastPoints.
  void speeds(std::span<const Eigen::Vector3f> path, std::vector<double>& out) const;
  /// Squared length of the third derivative, (m/s³)², likewise.
  void squared_jerks(std::span<const Eigen::Vector3f> path, std::vector<double>& out) const;
  std::int64_t window() const noexcept { return 2 * half_ + 1; }

 private:
  void fit(std::span<const Eigen::Vector3f> path, std::int64_t order, std::vector<double>& out) const;

  double hertz_;
  std::int64_t half_;
};
inline constexpr Seconds kPathWindow{0.1};

/// Length of a path, metres.
double length_of(std::span<const Eigen::Vector3f> path) noexcept;

/// Log-dimensionless jerk: −ln(T³ / v² · ∫ jerk² dt), T the duration and v the peak speed (Hogan and Sternad 2009;
/// Balasubramanian et al. 2015, "LDLJ-V"). Higher is smoother; −5.32 for a minimum-jerk movement from rest to rest. NaN
/// if nothing moves or there are fewer than five points.
double log_dimensionless_jerk(std::span<const double> speeds, std::span<const double> squared_jerks,
                              FrameRate rate) noexcept;

/// Spectral arc length of a speed profile (Balasubramanian et al. 2015), with its usual parameters: padded by 2⁴, up to
/// 10 Hz, amplitudes from 0.05. Higher is smoother. NaN if nothing moves.
double spectral_arc_length(std::span<const double> speeds, FrameRate rate);

}  // namespace signweave
