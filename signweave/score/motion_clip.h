#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/core/time.h"
#include "signweave/features/hand_motion.h"
#include "signweave/motion/motion_source.h"
#include "signweave/score/junction_choice.h"
#include "signweave/score/score.h"
#include "signweave/transition/joint_groups.h"

namespace signweave {

/// A clip of a recording, ready to be joined. Its frames are read when they are needed, straight into the result.
struct MotionClip {
  std::string recording;                       ///< empty of frames that are of none
  std::shared_ptr<const MotionSource> source;  ///< the recording's motion
  FrameRange whole;         ///< what may be used of it: the core with the first preparation and the last retraction
  FrameRange core;          ///< the frames of the recording that are kept as they are; inside `whole`, not empty
  FrameClock clock;         ///< of the recording
  std::vector<Sign> signs;  ///< in the recording's annotation time
  Milliseconds pause_before{0};
  JunctionChoice junction{};      ///< of the junction before it
  std::uint64_t fingerprint = 0;  ///< of the recording's motion file; 0: not known
  std::optional<std::size_t> place =
      {};  ///< of what was asked for, from 0: the first that it is of; none: as it is counted
  std::vector<std::size_t> sign_places = {};  ///< [sign] the place that it is of; empty: all are of `place`
  SourceRef::Kind kind = SourceRef::Kind::recording;
  /// Of its motion, in the joints of `source`; null: not known, or shown on another skeleton.
  std::shared_ptr<const CaptureNoise> noise = nullptr;
};

/// The place that one of its signs is of; `number`: the place of a clip that names none.
inline std::size_t place_of_sign(const MotionClip& clip, std::size_t sign, std::size_t number) {
  return clip.sign_places.empty() ? clip.place.value_or(number) : clip.sign_places[sign];
}

/// Where a clip is from, as a score names it.
inline SourceRef source_of(const MotionClip& clip) {
  return {clip.kind, clip.recording, clip.fingerprint};
}

/// Which joint of the result is what.
struct SignerRig {
  SignerModel signer;
  JointGroups groups;
};
}  // namespace signweave
