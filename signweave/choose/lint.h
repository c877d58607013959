#pragma once

#include <vector>

#include "signweave/choose/channel_clips.h"
#include "signweave/choose/compose.h"
#include "signweave/core/error.h"
#include "signweave/motion/motion.h"
#include "signweave/score/motion_clip.h"
#include "signweave/score/score.h"

namespace signweave {

/// What was composed. Everything must outlive the call.
struct ComposedChannels {
  const Score& score;
  const std::vector<MotionClip>&
      clips;  ///< [clip of the score]: of the whole body, `body` in number, then of the parts
  std::size_t body = 0;
  const ChannelParts& parts;  ///< their `clip` is not used
  const Motion& motion;       ///< the score's frames from `first` on
  std::int64_t first = 0;
  const Continuation* before = nullptr;  ///< its fixed clips were examined before; null: none were
};

/// Finds what composed hands do that signers rarely do, and returns a notice for each, with a code:
/// - `symmetry`: both hands move, with different handshapes (Battison 1978);
/// - `dominance`: a hand is held beside a moving one with a marked handshape of its own (Battison 1978);
/// - `long_hold`: a pose is held for more than kLongHold, or across a full stop;
/// - `collision`: hands are deeper in each other than captured plus 3 mm, or cross as in none of their sources;
/// - `weak_drop`: a hand does something else during a sign in which both hands touch or alternate.
/// These are permissions and tendencies of the sign languages that were studied, not laws of all. Measures the frames
/// in which parts are shown. What fixed clips do with each other is not examined again. A pose that is held until the
/// last clip ends is held for so long at least; after that, it is not reported again.
std::vector<Notice> lint_channels(const ComposedChannels& made, const SignerRig& rig);

/// Throws Error{bad_input} that tells the first of these notices, if there are any.
void refuse(const std::vector<Notice>& found);

/// A pose that is held longer is reported. The longest of 600 weak-hand holds in corpora are of this order. (ours)
inline constexpr Seconds kLongHold{5.0};

}  // namespace signweave
