#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "signweave/core/time.h"

namespace signweave {

/// First and second derivatives of a path at one frame.
struct PathDerivatives {
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();      ///< the path's unit a second
  Eigen::Vector3f acceleration = Eigen::Vector3f::Zero();  ///< the path's unit a second squared
};

/// Fits a quadratic to the frames around one frame by least squares (Savitzky and Golay, Smoothing and differentiation
/// of data by simplified least squares procedures, Analytical Chemistry 36, 1964). The window is the largest odd number
/// of frames within `width`, 3 to kMostWindow. Near the ends of a motion it keeps its size and shifts inwards, so that
/// the fit is evaluated off its centre; a shorter motion is one window. Two frames give only a velocity, one frame
/// gives zeros.
class Smoother {
 public:
  static constexpr std::int64_t kMostWindow = 257;

  /// For a motion of `frames` frames.
  Smoother(Seconds width, FrameRate rate, std::int64_t frames);

  /// Returns the frames used for frame `frame` of the motion.
  FrameRange window(std::int64_t frame) const noexcept;
  /// Returns the frames used for a range of frames (at least one), which must lie within the motion.
  FrameRange window(FrameRange frames) const noexcept;

  /// Returns the derivatives at `frame` of the motion. `path` starts at frame `first` and must contain all of
  /// window(frame). The same frames give bit-identical results, whatever else the path contains.
  PathDerivatives at(std::int64_t frame, std::span<const Eigen::Vector3f> path, std::int64_t first) const noexcept;

 private:
  std::int64_t frames_;
  std::int64_t size_;  ///< size of the window
  float hertz_;
  std::vector<float> slope_;      ///< [frame of the window] weights of the fit's slope at the centre, per frame
  std::vector<float> curvature_;  ///< [frame of the window] weights of its second derivative, per frame squared
};

}  // namespace signweave
