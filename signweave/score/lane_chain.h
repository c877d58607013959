#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "signweave/score/score.h"
#include "signweave/score/transition.h"

namespace signweave {

/// A clip in a lane, with the transition after it.
struct LaneLink {
  ClipId clip = 0;
  std::int64_t held_before = 0;  ///< output frames of its first pose before it; only for the first clip of a lane
  /// Output frames for which its last pose is held: after its core, or for the last clip of a lane, at the end.
  std::int64_t held = 0;
  TransitionCut cut;                    ///< of the transition to the next clip; not used for the last
  std::optional<HandPlace> place = {};  ///< see ClipUse
  friend bool operator==(const LaneLink&, const LaneLink&) = default;
};
/// The clips that a channel shows, one after another: a lane without the positions that follow from its clips.
using LaneChain = std::vector<LaneLink>;

/// The chain of a lane whose items are as `check` requires.
LaneChain chain_of(const Lane& lane);

/// The lane of a chain, given the clips' positions and the length of the output. The transition after a clip begins
/// where its cut ends the retraction.
Lane lane_of(Channel channel, const LaneChain& chain, const std::vector<Clip>& clips, std::int64_t frames);

/// Consecutive links [first, last] of a lane between which it does not show what its parent does.
struct LaneDifference {
  std::size_t first = 0;
  std::size_t last = 0;         ///< inclusive
  bool from_parent = false;     ///< the parent shows the first clip as well; false: the lane begins with the range
  bool back_to_parent = false;  ///< the parent shows the last clip as well; false: the lane ends with the range
};
/// The ranges of links in which a lane differs from its parent's. `same_cuts` says whether transitions that both have
/// must be cut alike; the arms are cut apart from the body.
std::vector<LaneDifference> differences(const LaneChain& lane, const LaneChain& parent, bool same_cuts);

/// The lanes of a score that show something else than their parent or, without parent, than the body.
std::vector<const Lane*> lanes_that_differ(const Score& score);

}  // namespace signweave
