#pragma once

#include <string_view>

#include "signweave/motion/motion.h"

namespace signweave {

/// How a frame between two captured frames is computed.
enum class RateMethod {
  slerp,    ///< interpolation along the shortest arc; linear for positions and tracks
  nearest,  ///< the nearer of the two frames, or the earlier one if equally near: every pose is a captured one
};
std::string_view name_of(RateMethod method) noexcept;

/// Returns the motion at another rate. Frame k of the result is the pose at time k / rate; the last frame is the last
/// one not after the last captured frame: nothing is extrapolated. Frames that coincide with captured ones are copied
/// bit for bit. Movement faster than half the new rate is not filtered out first.
Motion resampled(const Motion& motion, FrameRate rate, RateMethod method = RateMethod::slerp);

}  // namespace signweave
