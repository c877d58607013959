#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/motion/motion.h"
#include "signweave/score/junction_choice.h"
#include "signweave/score/score.h"
#include "signweave/score/transition.h"

namespace signweave {

/// Where an output frame comes from: of a recording where every part of the body is as captured.
struct FrameSource {
  static constexpr std::int32_t kNone = -1;
  std::int32_t clip = kNone;      ///< index of the clip whose recording it shows, or kNone
  std::int32_t junction = kNone;  ///< index of the junction whose transition it belongs to, or kNone
  double frame = 0;               ///< where `clip` is given: the (fractional) frame of the recording
};

/// One place where two clips were joined.
struct Junction {
  std::string from;  ///< gloss of the last sign before, or the recording's name
  std::string to;
  FrameRange frames;    ///< output frames between the two strokes
  TransitionCut cut;    ///< what is kept of all parts together
  TransitionCuts cuts;  ///< [Timed] what is kept of each
  std::string method;
  std::size_t number = 0;   ///< by which it is named: 1 is that of the first two clips, or of their places
  JunctionChoice chosen{};  ///< what was asked for it alone
};

/// Where a clip lies in the result.
struct ShownClip {
  std::string recording;
  FrameRange output;       ///< output frames of its core, with its preparation if it is first, its retraction if last
  FrameRange core;         ///< output frames of its core
  double first_frame = 0;  ///< frame of the recording at core.begin
  double step = 1;         ///< frames of the recording per output frame
};

/// A sign as it lies in the result.
struct PlacedSign {
  Sign sign;              ///< times are output time; its phases fill it
  std::size_t clip = 0;   ///< which holds it: the id of its clip
  std::size_t place = 0;  ///< of what was asked for, from 0
  TimeSpan recorded;      ///< where it was in its recording
};

/// What was made, and of what.
struct Synthesis {
  Motion motion;
  Score score;                       ///< that it was rendered from
  std::vector<FrameSource> sources;  ///< [output frame]
  std::vector<ShownClip> clips;
  std::vector<Junction> junctions;  ///< [clip − 1]
  std::vector<PlacedSign> signs;    ///< in time order
  std::vector<Notice> notices;
  /// What the sources' documents say of themselves and must not be lost on the way: properties "signweave:…", such as
  /// that a demo's shapes are placeholders. Name and value, each once.
  std::vector<std::pair<std::string, std::string>> declarations;
};

}  // namespace signweave
