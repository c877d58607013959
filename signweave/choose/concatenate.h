#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "signweave/choose/standing.h"
#include "signweave/core/time.h"
#include "signweave/features/duration_fit.h"
#include "signweave/score/motion_clip.h"
#include "signweave/score/result.h"

namespace signweave {

/// Measured over at most kBodyFrames of a clip's core.
SignerRig signer_rig_of(const MotionClip& clip);

struct ConcatenateOptions {
  const TransitionMethod* method = nullptr;  ///< null: the default
  Milliseconds duration{0};                  ///< of each transition at tempo 1, without pauses
  /// Where given, tells the duration of each transition from what the hands have to do. Borrowed.
  const DurationFit* fit = nullptr;
  /// What the method has learned, and the captured spans that it may need; null: the default. Borrowed.
  const TransitionModel* model = nullptr;
  const SignerRig* rig = nullptr;  ///< of the reference; null: measured from its frames and names. Borrowed
  double tempo = 1;                ///< above 1 is faster; positive
  FrameRate rate{0, 1};            ///< of the output; 0: the highest of the sources
  Alignment alignment = Alignment::automatic;
  std::int64_t most_frames = kMostFrames;  ///< a result that would have more is refused before a frame is read
  std::size_t reference = 0;  ///< the clip that gives skeleton and standing: in an edit, one of the edited recording
};

/// Joins clips (the paper's Algorithm 1 between each two of them, for each part of the body with a cut of its own).
/// Every core is kept as captured: at the source's own rate and tempo 1 its rotations have the source's bits, up to the
/// quaternion's sign and the root's alignment; else they are the source interpolated at the stated frame. Alignment
/// always goes to where the reference's signer stands, so nothing drifts. The result has the reference's skeleton.
///
/// Scalar tracks come along: a track that one of the sources has is in the result, at 0 where a source lacks it, and
/// goes over in each transition from where it was to where it will be.
///
/// `used` is an older result whose memory may be used again. Throws Error{bad_input} where skeletons differ in more
/// than offsets (naming the joint; see put_on_skeleton), or nothing is to be joined; Error{corrupt} where frames are
/// damaged.
Synthesis concatenate(const std::vector<MotionClip>& clips, const ConcatenateOptions& options, Synthesis used = {});

}  // namespace signweave
