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
#include "signweave/motion/motion.h"
#include "signweave/transition/joint_groups.h"

namespace signweave {

/// A recording to be evaluated on, and what is needed of it again and again.
struct EvaluatedMotion {
  std::string name;
  Motion motion;  ///< neighbours in one hemisphere
  /// What the frames beside spans are taken from where they are to shake, see shake; null: from `motion`.
  std::shared_ptr<const Motion> shaken;
  CaptureNoise noise;  ///< of what these frames are taken from
  SignerModel signer;
  JointGroups groups;
  std::vector<Sign> signs;  ///< none: not annotated
  FrameClock clock;
  HandTracks tracks;           ///< over the whole motion
  std::vector<bool> unusable;  ///< [frame] T-pose, jump, no number: no span and no context may hold it
  std::string collection;      ///< recordings made together: a folder, a database; see Folds
  std::string performer;       ///< who signs; empty: not known
};

/// A recording for the evaluation. `signs` may be empty; most of them tell who performs. Throws Error{unsupported,
/// "NAME: …"} where there is no wrist to look at, or fewer frames than kLeastFrames: nothing is wrong with such a
/// motion, but nothing can be told of it.
EvaluatedMotion evaluated_motion(std::string name, Motion motion, const RigMap& rig, std::vector<Sign> signs,
                                 const FrameClock& clock);
inline constexpr std::int64_t kLeastFrames = 8;

}  // namespace signweave
