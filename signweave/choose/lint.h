#pragma once

#include <vector>

#include "signweave/choose/channel_clips.h"
#include "signweave/core/error.h"
#include "signweave/notation/utterance.h"
#include "signweave/score/motion_clip.h"
#include "signweave/score/result.h"

namespace signweave {

/// Finds what composed hands do that signers rarely do, and returns a notice for each, with a code:
/// - `symmetry`: both hands move, with different handshapes (Battison 1978);
/// - `dominance`: a hand is held beside a moving one with a marked handshape of its own (Battison 1978);
/// - `long_hold`: a pose is held for more than kLongHold, or across a full stop;
/// - `collision`: hands are deeper in each other than captured plus 3 mm, or cross as in none of their sources;
/// - `weak_drop`: a hand does something else during a sign in which both hands touch or alternate.
/// These are permissions and tendencies of the sign languages that were studied, not laws of all. `clips` are the
/// whole-body clips, `utterance` has the pauses; null: an edit. Measures the result's frames in which parts are shown.
std::vector<Notice> lint_channels(const Synthesis& made, const std::vector<MotionClip>& clips,
                                  const ChannelParts& parts, const SignerRig& rig, const Utterance* utterance);

/// A pose that is held longer is reported. The longest of 600 weak-hand holds in corpora are of this order. (ours)
inline constexpr Seconds kLongHold{5.0};

}  // namespace signweave
