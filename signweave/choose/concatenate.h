#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
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

/// The signer and joint groups of a clip, measured over at most kBodyFrames of its core.
SignerRig signer_rig_of(const MotionClip& clip);

struct ConcatenateOptions {
  const TransitionMethod* method = nullptr;  ///< null: the default
  Milliseconds duration{0};                  ///< of each transition at tempo 1, without pauses
  /// If not null, predicts the duration of each transition from the movement of the hands. Borrowed.
  const DurationFit* fit = nullptr;
  /// The method's learned model with the captured spans that it may need; null: the default. Borrowed.
  const TransitionModel* model = nullptr;
  const SignerRig* rig = nullptr;  ///< of the reference; null: measured from its frames and joint names. Borrowed
  double tempo = 1;                ///< above 1 is faster; positive
  FrameRate rate{0, 1};            ///< of the output; 0: the highest rate of the sources
  Alignment alignment = Alignment::automatic;
  std::int64_t most_frames = kMostFrames;  ///< longer results are rejected before a frame is read
  /// If given, called with the score once all times are known; returns what is shown over it.
  std::function<std::vector<AuthoredCurve>(const Score&)> author;
  std::size_t reference = 0;  ///< the clip that defines skeleton and standing: in an edit, one of the edited recording
};

/// Joins clips (the paper's Algorithm 1 between each two of them, with separate cuts for each part of the body). Every
/// core is preserved: at the source's rate and tempo 1 its rotations are bit-identical to the source, up to the
/// quaternion's sign and the root's alignment; otherwise they are the source interpolated at the stated frame. Clips
/// are always aligned to the reference's signer, so alignment does not drift. The result has the reference's skeleton.
///
/// The result has all scalar tracks of the sources. A track is 0 where a source lacks it, and is interpolated in each
/// transition.
///
/// `used` is an older result whose memory may be reused. Throws Error{bad_input} if skeletons differ in more than
/// offsets (naming the joint; see put_on_skeleton) or `clips` is empty; Error{corrupt} if frames are damaged.
Synthesis concatenate(const std::vector<MotionClip>& clips, const ConcatenateOptions& options, Synthesis used = {});

}  // namespace signweave
