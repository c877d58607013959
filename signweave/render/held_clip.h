#pragma once

#include <cstdint>
#include <memory>

#include "signweave/render/placed_clip.h"

namespace signweave {

/// Output frames for which poses of a clip are held.
struct HeldFrames {
  std::int64_t before = 0;      ///< its first pose, before it
  std::int64_t after_core = 0;  ///< the last pose of its core, instead of its retraction
  std::int64_t at_end = 0;      ///< the last pose of the shown part of its retraction (PlacedClip::after)
  bool any() const noexcept { return before > 0 || after_core > 0 || at_end > 0; }
};

/// A placed clip with held poses, as a clip of its own in which they are captured frames.
struct HeldClip {
  std::shared_ptr<const MotionClip> clip;
  PlacedClip placed;  ///< points to `clip`; as `placed` before, with the held frames in preparation, core or retraction
};

/// Holds poses of a placed clip. Other frames are unchanged. At most one of `after_core` and `at_end` may be positive.
HeldClip hold(const PlacedClip& placed, const HeldFrames& held);

}  // namespace signweave
