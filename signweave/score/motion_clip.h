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

/// A clip of a recording, ready to be joined. Its frames are read on demand, directly into the result.
/// More than fifteen members: those of a score's Clip, and what its frames are read from.
struct MotionClip {
  std::string recording;                       ///< empty if the frames are of no recording
  std::shared_ptr<const MotionSource> source;  ///< the recording's motion
  FrameRange whole;         ///< usable frames: the core with the first preparation and the last retraction
  FrameRange core;          ///< recording frames that are never changed; inside `whole`, not empty
  FrameClock clock;         ///< of the recording
  std::vector<Sign> signs;  ///< in the recording's annotation time
  Milliseconds pause_before{0};
  JunctionChoice junction{};                  ///< of the junction before it
  std::uint64_t fingerprint = 0;              ///< of the recording's motion file; 0: unknown
  std::optional<std::size_t> place = {};      ///< first place that it fills, from 0; none: its number among the clips
  std::vector<std::size_t> sign_places = {};  ///< [sign] the place that the sign fills; empty: `place` for all
  /// Its core follows the previous clip's core in the recording, and the frames between are part of that clip's
  /// `whole`: `compose` keeps them as the transition unless there is more time.
  bool continues = false;
  SourceRef::Kind kind = SourceRef::Kind::recording;
  /// Noise of its motion, in the joints of `source`; null: unknown, or retargeted to another skeleton.
  std::shared_ptr<const CaptureNoise> noise = nullptr;
  bool mirrored = false;  ///< `source` shows the recording with left and right exchanged
  bool at_rest = false;   ///< see Clip
  /// See Clip; `source` has them already once the clip is inflected (choose/inflect.h).
  std::vector<ClipChange> changes = {};
  double speed = 1;  ///< of this clip besides the tempo of all
};

/// The place that one of a clip's signs fills; `number` is used for a clip without `place`.
inline std::size_t place_of_sign(const MotionClip& clip, std::size_t sign, std::size_t number) {
  return clip.sign_places.empty() ? clip.place.value_or(number) : clip.sign_places[sign];
}

/// The source of a clip, as stored in a score.
inline SourceRef source_of(const MotionClip& clip) {
  return {clip.kind, clip.recording, clip.fingerprint};
}

/// The roles of the result's joints.
struct SignerRig {
  SignerModel signer;
  JointGroups groups;
};
}  // namespace signweave
