#pragma once

#include <span>
#include <string>
#include <vector>

#include "signweave/database/database.h"
#include "signweave/score/transition.h"

namespace signweave::calls {

/// Returns why `text` is not a "FROM..TO" in ms of annotation time; empty if it is one.
std::string check_span(const std::string& text);

/// The least number of captured frames on both sides of a gap: what a velocity is computed from.
inline constexpr std::int64_t kCapturedAround = 3;

/// Returns the frames of a recording that spans "FROM..TO" cut out, in order. `shown`: the frames that are exported.
/// Throws Error{bad_input} if a span has no frame, or if fewer than kCapturedAround of those shown are left on either
/// side.
std::vector<FrameRange> gaps_of(std::span<const std::string> spans, const RecordingInfo& info, FrameRange shown);

/// The part of a recording to regenerate.
struct RegenerateJob {
  const RecordingInfo& info;         ///< of the snapshot
  FrameRange shown;                  ///< the frames of the recording that the motion has
  const JointSet& joints;            ///< the requested joints; empty: all
  std::span<const FrameRange> gaps;  ///< see gaps_of
  const TransitionMethod& method;
};

/// Regenerates the gaps of `motion`, each with as many frames as were cut out, as the evaluation's task "given" does:
/// from the captured frames within kContext of it, including those outside `shown`, but excluding those of other gaps.
/// Every frame outside the gaps is unchanged to the bit. A method that uses captured spans gets only those of other
/// recordings. Scalar tracks are filled as in a transition. Throws Error{corrupt}, Error{conflict} if the motion is not
/// of the snapshot.
void regenerate(const Snapshot& snapshot, const RegenerateJob& job, Motion& motion, std::vector<Notice>& notices);

}  // namespace signweave::calls
