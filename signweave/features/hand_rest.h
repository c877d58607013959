#pragma once

#include <cstdint>
#include <optional>

#include "signweave/core/time.h"
#include "signweave/features/hand_trace.h"

namespace signweave {

/// The captured frames around the moment at which one hand is most at rest: low and still, the hips and everything
/// below counting as equally low. Of moments that are almost equally at rest, the one nearest to frame `near`. At most
/// kRestLength long, inside the motion, not empty. None if the hand was not traced. The costs are those of
/// live/rest_pose, for one hand.
std::optional<FrameRange> hand_rest(const HandTrace& trace, Side side, std::int64_t near);
inline constexpr Seconds kRestLength{0.1};

}  // namespace signweave
