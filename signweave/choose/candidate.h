#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/core/time.h"
#include "signweave/database/database.h"
#include "signweave/notation/utterance.h"

namespace signweave {

/// A part of one recording that may fill one place: usually one sign, in an edit a run of signs as captured.
struct Candidate {
  std::size_t recording = 0;   ///< index into Contents::recordings
  std::vector<Sign> signs;     ///< in time order; empty for a piece of a recording
  std::vector<Sign> left_out;  ///< signs without stroke at the ends of a run; they cannot be kept at a cut
  FrameRange whole;            ///< with preparation and retraction; inside the motion
  FrameRange core;             ///< from the first stroke's begin to the last stroke's end; never changed, not empty
  std::size_t token = 0;       ///< its token number within the gloss, from 1; 0 for a run or a piece
  RowId first_row = kNoRow;    ///< of signs.front() in Contents::segments; kNoRow if there are none
  RowId last_row = kNoRow;     ///< of signs.back()
  bool at_strokes = true;      ///< the core begins and ends with strokes of those signs; false for a piece

  const std::string& gloss() const noexcept { return signs.front().gloss; }
};

/// Every token of a gloss in the order of `#N`: by recording name, then time.
std::vector<RowId> tokens_of(const Contents& contents, std::string_view gloss);

/// The candidates for a sign or a piece. Tokens without stroke or motion, or outside their motion, are skipped;
/// requesting one by number is an error that gives the reason. Throws Error{not_found} with near matches for an unknown
/// gloss.
std::vector<Candidate> candidates_for(const Contents& contents, const SignRef& sign);

/// A run of consecutive signs of one recording, in time order, as one candidate, from its first sign with a stroke to
/// its last. Returns none if no sign has a stroke inside the motion.
std::optional<Candidate> candidate_of_run(const Contents& contents, std::size_t recording, std::vector<Sign> signs);

/// Extends `last` by the signs of `next`, which follows it in the recording (`are_neighbours`). The result is one clip
/// that contains the recorded transition.
void extend_with(Candidate& last, const Candidate& next);

}  // namespace signweave
