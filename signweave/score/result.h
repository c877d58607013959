#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "signweave/annotation/declarations.h"
#include "signweave/annotation/sign.h"
#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/motion/motion.h"
#include "signweave/score/junction_choice.h"
#include "signweave/score/score.h"
#include "signweave/score/transition.h"

namespace signweave {

/// Where an output frame comes from. It comes from a recording only if every part of the body is as captured.
struct FrameSource {
  static constexpr std::int32_t kNone = -1;
  std::int32_t clip = kNone;      ///< index of the clip that it shows, or kNone
  std::int32_t junction = kNone;  ///< index of the junction whose transition it belongs to, or kNone
  double frame = 0;               ///< if `clip` is set: the (fractional) frame of the recording
};

/// A junction between two clips.
struct Junction {
  std::string from;  ///< gloss of the last sign before, or the recording's name
  std::string to;
  FrameRange frames;    ///< output frames between the two strokes
  TransitionCut cut;    ///< frames kept for all parts of the body
  TransitionCuts cuts;  ///< [Timed] frames kept for each part
  std::string method;
  std::size_t number = 0;   ///< number used to refer to it: 1 is that of the first two clips, or of their places
  JunctionChoice chosen{};  ///< options given for it alone
};

/// The position of a clip in the result.
struct ShownClip {
  std::string recording;
  Channel channel = Channel::body;  ///< `body`: the whole body, except where other lanes differ
  /// Of its core; if first or last, with its preparation or retraction. For a clip of one channel, all that is shown.
  FrameRange output;
  FrameRange core;         ///< output frames of its core
  double first_frame = 0;  ///< frame of the recording at core.begin
  double step = 1;         ///< frames of the recording per output frame
};

/// A sign in the result.
struct PlacedSign {
  Sign sign;                        ///< in output time; its phases cover it without gaps
  Channel channel = Channel::body;  ///< as that of its clip
  std::size_t clip = 0;             ///< id of the clip that contains it
  std::size_t place = 0;            ///< place of the request, from 0
  TimeSpan recorded;                ///< its span in its recording
};

/// A generated motion and its provenance.
struct Synthesis {
  Motion motion;
  Score score;                       ///< it was rendered from this
  std::vector<FrameSource> sources;  ///< [output frame]
  std::vector<ShownClip> clips;      ///< [ClipId]
  std::vector<Junction> junctions;   ///< [clip − 1] of the clips of the whole body
  std::vector<PlacedSign> signs;     ///< in time order, those of the whole body first
  std::vector<Notice> notices;
  Declarations declarations;  ///< of the source recordings: sorted, each once
};

}  // namespace signweave
