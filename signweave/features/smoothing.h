#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "signweave/core/time.h"

namespace signweave {

/// First and second derivative of a path at one frame.
struct PathDerivatives {
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();      ///< the path's unit a second
  Eigen::Vector3f acceleration = Eigen::Vector3f::Zero();  ///< the path's unit a second squared
};

/// Fits a quadratic to the frames around one frame by least squares (Savitzky and Golay, Smoothing and differentiation
/// of data by simplified least squares procedures, Analytical Chemistry 36, 1964). The window is as many whole frames
/// as reach `width` and no farther, an odd number, 3 to kMostWindow; near the ends of a motion it keeps its size and
/// moves inside, so that the fit is looked at off its middle; a shorter motion is one window. Two frames give a
/// velocity alone, one frame nothing.
class Smoother {
 public:
  static constexpr std::int64_t kMostWindow = 257;

  /// For a motion of so many frames.
  Smoother(Seconds width, FrameRate rate, std::int64_t frames);

  /// The frames that are looked at for frame `frame` of the motion.
  FrameRange window(std::int64_t frame) const noexcept;
  /// The frames that are looked at for some frames (at least one), which must lie within the motion.
  FrameRange window(FrameRange frames) const noexcept;

  /// At `frame` of the motion, which `path` holds from frame `first` on: all of window(frame). The same frames give the
  /// same bits, whatever else the path holds.
  PathDerivatives at(std::int64_t frame, std::span<const Eigen::Vector3f> path, std::int64_t first) const noexcept;

 private:
  std::int64_t frames_;
  std::int64_t size_;  ///< of the window
  float hertz_;
  std::vector<float> slope_;      ///< [frame of the window] weights of the fit's slope in the middle, per frame
  std::vector<float> curvature_;  ///< [frame of the window] weights of its second derivative, per frame squared
};

}  // namespace signweave
