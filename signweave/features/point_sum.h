#pragma once

#include <algorithm>

#include "signweave/features/point_track.h"

namespace signweave {

/// Computes `over` incrementally, so that a long range of frames need not be in memory.
class PointSum {
 public:
  void add(const PointFrame& frame) noexcept {
    const float speed = frame.velocity.norm();
    over_.peak_speed = std::max(over_.peak_speed, speed);
    over_.peak_acceleration = std::max(over_.peak_acceleration, frame.acceleration);
    over_.contact = over_.contact | frame.state.contact;
    speeds_ += static_cast<double>(speed);
    accelerations_ += static_cast<double>(frame.acceleration);
    if (count_ > 0) path_ += 0.5 * (static_cast<double>(speed) + before_);
    before_ = static_cast<double>(speed);
    if (count_ == 0) over_.begin = frame;
    over_.end = frame;
    count_ += 1;
  }

  /// Returns the result for the added frames; at least one must have been added.
  PointOver over(FrameRate rate, float shoulder_width) const noexcept {
    PointOver result = over_;
    result.mean_speed = static_cast<float>(speeds_ / count_);
    result.mean_acceleration = static_cast<float>(accelerations_ / count_);
    result.path_length = static_cast<float>(path_ * rate.frame_time().count());
    result.displacement = (over_.end.position - over_.begin.position).norm() * shoulder_width;
    return result;
  }

 private:
  PointOver over_;
  double path_ = 0;  ///< speed summed over frames
  double speeds_ = 0;
  double accelerations_ = 0;
  double before_ = 0;  ///< speed of the last frame
  double count_ = 0;
};

}  // namespace signweave
