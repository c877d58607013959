#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "signweave/core/time.h"

namespace signweave {

/// From 0 to 1 with zero velocity at both ends; constant outside [0, 1].
inline float smooth_step(float share) noexcept {
  const float t = std::clamp(share, 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// A weight over output frames: 0 outside them, rising over whole frames, 1, falling. If rise and fall do not fit, both
/// are shortened in proportion; at least one frame has the value 1.
class Envelope {
 public:
  Envelope(FrameRange at, Milliseconds onset, Milliseconds offset, FrameRate rate) noexcept
      : at_(at), rise_(frames(onset, rate)), fall_(frames(offset, rate)) {
    const std::int64_t size = std::max<std::int64_t>(at.size(), 0);
    if (rise_ + fall_ > size) {
      const double share = static_cast<double>(rise_) / static_cast<double>(rise_ + fall_);
      rise_ = std::min<std::int64_t>(std::llround(share * static_cast<double>(size)), size - 1);
      fall_ = size - rise_;
    }
  }

  float operator()(std::int64_t frame) const noexcept {
    if (frame < at_.begin || frame >= at_.end) return 0;
    const std::int64_t in = frame - at_.begin;
    const std::int64_t out = at_.end - frame;
    if (in < rise_) return smooth_step(static_cast<float>(in) / static_cast<float>(rise_));
    if (out < fall_) return smooth_step(static_cast<float>(out) / static_cast<float>(fall_));
    return 1;
  }

  static std::int64_t frames(Milliseconds time, FrameRate rate) noexcept {
    return std::llround(count_of(time) * rate.hertz() / 1000);
  }

 private:
  FrameRange at_;
  std::int64_t rise_ = 0;
  std::int64_t fall_ = 0;
};

}  // namespace signweave
