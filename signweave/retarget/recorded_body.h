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

/// The signer's body as seen in a recording: enough to retarget other motions to it, and its own motion to other
/// bodies.
struct RecordedBody {
  std::string recording;
  SignerModel signer;
  Motion frames;  ///< at most kSeenFrames frames, evenly distributed over the recording, without tracks
};
inline constexpr std::int64_t kSeenFrames = 120;

/// Examines a recording, which must have a frame. `names`: the content of a mapping file. Reads at most a few hundred
/// single frames; throws what reading throws.
RecordedBody recorded_body(std::string recording, const MotionSource& source, const RigNames& names = {});

/// Returns the usual pose of a motion of at least one frame: the mean of each rotation, in the hemisphere of the first
/// frame, and the median of each translation. Non-finite values are skipped.
Pose usual_pose(const Motion& motion);

/// Returns the skeleton with the bones' usual lengths: a translated joint's offset is its position in `usual`. If
/// `only_root` is set, only the root remains translated.
struct BoneLengths {
  bool only_root = false;
};
Skeleton with_usual_bones(const Skeleton& skeleton, const Pose& usual, BoneLengths which);

/// Returns the body as a character: its own bones, map and sizes; fingers without limits, so that handshapes are
/// transferred as captured. Undriven joints take the signer's usual pose. It has no surface.
Character character_of(const RecordedBody& body, const Pose& usual);

}  // namespace signweave
