#pragma once

#include <span>
#include <string>
#include <vector>

#include "signweave/database/database.h"
#include "signweave/score/transition.h"

namespace signweave::calls {

/// Empty, or why `text` is no "FROM..TO" in ms of annotation time.
std::string check_span(const std::string& text);

/// So many captured frames must lie on both sides of what is cut out: what it takes to tell a velocity.
inline constexpr std::int64_t kBesideRemade = 3;

/// The frames of a recording that spans "FROM..TO" cut out, in order. `shown`: the frames of it that are exported.
/// Throws Error{bad_input} where a span has no frame, or fewer than kBesideRemade of those shown are left on either
/// side.
std::vector<FrameRange> gaps_of(std::span<const std::string> spans, const RecordingInfo& info, FrameRange shown);

/// What is made again of a recording.
struct RemakeJob {
  const RecordingInfo& info;         ///< of the snapshot
  FrameRange shown;                  ///< of the recording's frames those that the motion has
  const JointSet& joints;            ///< that are wanted; all where empty
  std::span<const FrameRange> gaps;  ///< see gaps_of
  const TransitionMethod& method;
};

/// Makes the gaps of `motion` again, each with as many frames as were cut out, as the evaluation's task "given" does:
/// from the captured frames within kContext of it, those of the recording beside what is shown among them, but none
/// that is cut out elsewhere. Every frame outside the gaps keeps its bits. A method that goes by captured spans gets
/// those of the other recordings alone. Scalar tracks go over as they do in a transition. Throws Error{corrupt},
/// Error{conflict} where the motion is not of the snapshot.
void remake(const Snapshot& snapshot, const RemakeJob& job, Motion& motion, std::vector<Notice>& notices);

}  // namespace signweave::calls
