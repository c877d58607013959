#pragma once

#include <string_view>

#include "signweave/motion/motion.h"

namespace signweave {

/// What a frame between two captured ones is.
enum class RateMethod {
  slerp,    ///< the shortest arc between the two, in proportion; linear for positions and tracks
  nearest,  ///< the nearer of the two, the earlier where both are as near: every pose is a captured one
};
std::string_view name_of(RateMethod method) noexcept;

/// The motion at another rate: frame k of the result is the pose at its own time k / rate, and the last is the last
/// that does not lie after the last captured frame; nothing is made beyond it. Frames that fall on captured ones are
/// theirs bit for bit. What moves faster than half the new rate is not filtered out first.
Motion resampled(const Motion& motion, FrameRate rate, RateMethod method = RateMethod::slerp);

}  // namespace signweave
