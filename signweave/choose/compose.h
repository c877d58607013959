#pragma once

#include <optional>
#include <vector>

#include "signweave/choose/channel_chains.h"
#include "signweave/choose/channel_clips.h"
#include "signweave/choose/concatenate.h"

namespace signweave {

/// Joins whole-body clips as `concatenate` does, while single channels show other clips or hold poses. Each lane has
/// its own transitions (Algorithm 1 with cut points of its own). The clips' times are the earliest that let every lane
/// have its transitions and that keep the given ties (see schedule.h); where a lane has time left, its last pose is
/// held until its transition begins, or the transition is up to half as long again. A hand goes to its rest once the
/// place before the rest's has ended, and leaves it as late as its next clip allows; nothing else waits for that.
///
/// A pose that is held until the last clip ends is let go: the hand joins the body's retraction, if that was captured.
///
/// Clips that continue the one before them (MotionClip::continues) keep the recorded transition. Without parts and such
/// clips, the result is that of `concatenate`. Throws as it does, and Error{bad_input} if parts contradict each
/// other; the message names those that do.
Synthesis compose(const std::vector<MotionClip>& clips, const ChannelParts& parts, const ConcatenateOptions& options,
                  Synthesis used = {});

/// What a hand shows after a pose that it holds until the end of the last whole-body clip: the end of that clip's
/// captured retraction (ChannelClip::lower). None if too little of one was captured.
std::optional<MotionClip> lowered_hand(const MotionClip& last);

/// Clips that are composed after others, which have their place already: what a stream signs next.
struct Continuation {
  std::vector<PlacedClip> placed;    ///< [clip] of the whole body, then of the parts; points to the caller's clips
  std::vector<bool> fixed;           ///< [clip] it stays where it is; the others get their place
  std::vector<ChannelStart> starts;  ///< what each lane begins with; empty: no clip is fixed
  std::vector<std::optional<HandPlace>> places;  ///< [clip] of fixed clips
  /// The number of fixed clips of parts, which come first among those of the parts.
  std::size_t known_parts = 0;
};
/// The score of such clips, with the places of hands. `clips` are those of the whole body, `body` in number, then those
/// of the parts. All have the joints of the settings, and are
/// where the signer stands. `options` are used for timing. Throws as `compose`.
Score compose_after(const Continuation& before, const std::vector<MotionClip>& clips, std::size_t body,
                    const ChannelParts& parts, const JunctionSettings& settings, const ConcatenateOptions& options);

}  // namespace signweave
