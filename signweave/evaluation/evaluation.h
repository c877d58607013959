#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/evaluation/hand_tracks.h"
#include "signweave/features/capture_noise.h"
#include "signweave/features/hand_motion.h"
#include "signweave/inflection/aim.h"
#include "signweave/motion/motion.h"
#include "signweave/transition/joint_groups.h"

namespace signweave {

/// A recording of an evaluation, with derived data that is used repeatedly.
struct EvaluatedMotion {
  std::string name;
  Motion motion;  ///< neighbours in one hemisphere
  /// The motion with added noise that the frames next to spans are taken from, see shake; null: taken from `motion`.
  std::shared_ptr<const Motion> shaken;
  CaptureNoise noise;  ///< of the motion that these frames are taken from
  SignerModel signer;
  JointGroups groups;
  std::vector<Sign> signs;            ///< empty: not annotated
  std::vector<LociOfSign> loci = {};  ///< [sign]; empty: not annotated
  FrameClock clock;
  HandTracks tracks;           ///< over the whole motion
  std::vector<bool> unusable;  ///< [frame] T-pose, jump or non-finite: must not be in a span or its context
  std::string collection;      ///< recordings captured together: a folder, a database; see Folds
  std::string performer;       ///< the signer; empty: unknown
};

/// Prepares a recording for the evaluation. `signs` may be empty; the performer is that of most of them. Throws
/// Error{unsupported, "NAME: …"} if there is no wrist, or fewer frames than kLeastFrames: such a motion is valid but
/// cannot be evaluated.
EvaluatedMotion evaluated_motion(std::string name, Motion motion, const RigMap& rig, std::vector<Sign> signs,
                                 const FrameClock& clock);
inline constexpr std::int64_t kLeastFrames = 8;

}  // namespace signweave
