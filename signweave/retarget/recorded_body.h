#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "signweave/features/hand_motion.h"
#include "signweave/motion/motion.h"
#include "signweave/motion/motion_source.h"
#include "signweave/retarget/character.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

/// What a recording shows of its signer's body: enough to put other motions onto it, and its own onto other bodies.
struct RecordedBody {
  std::string recording;
  SignerModel signer;
  Motion frames;  ///< at most kSeenFrames that lie evenly over the recording, without tracks
};
inline constexpr std::int64_t kSeenFrames = 120;

/// Looks at a recording, which must have a frame. `names`: what a mapping file says. Reads a few hundred single frames;
/// throws what reading throws.
RecordedBody recorded_body(std::string recording, const MotionSource& source, const RigNames& names = {});

/// How the joints mostly stand over a motion of at least one frame: the mean of each rotation, in the hemisphere of the
/// first frame, and the median of each translation. Numbers that are none are passed over.
Pose usual_pose(const Motion& motion);

/// The same skeleton with the bones as long as they mostly are: a translated joint's offset is its place in `usual`.
/// Where `only_root` is set, the root alone stays translated.
struct BoneLengths {
  bool only_root = false;
};
Skeleton with_usual_bones(const Skeleton& skeleton, const Pose& usual, BoneLengths which);

/// The body as a character: its own bones, map and sizes, fingers without limits, so that handshapes come over as they
/// were captured. What no motion drives stands as the signer mostly had it. Nothing is known of its surface.
Character character_of(const RecordedBody& body, const Pose& usual);

}  // namespace signweave
