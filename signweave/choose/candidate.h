#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/core/time.h"
#include "signweave/database/database.h"
#include "signweave/notation/utterance.h"

namespace signweave {

/// A clip of one recording that may fill one place: mostly one sign, in an edit a run of signs as captured.
struct Candidate {
  std::size_t recording = 0;   ///< index into Contents::recordings
  std::vector<Sign> signs;     ///< in time order; empty for a bare piece of a recording
  std::vector<Sign> left_out;  ///< signs without stroke at the ends of a run: nothing of them can be kept at a cut
  FrameRange whole;            ///< with preparation and retraction; within the motion
  FrameRange core;             ///< from the first stroke's begin to the last stroke's end: never changed. Not empty
  std::size_t token = 0;       ///< which token of its gloss it is, from 1; 0 for a run or a piece
  RowId first_row = kNoRow;    ///< of signs.front() in Contents::segments; kNoRow where there are none
  RowId last_row = kNoRow;     ///< of signs.back()
  bool at_strokes = true;      ///< the core begins and ends with strokes of those signs; false for a piece

  const std::string& gloss() const noexcept { return signs.front().gloss; }
};

/// Every token of a gloss in the order in which `#N` counts them: by recording name, then time.
std::vector<RowId> tokens_of(const Contents& contents, std::string_view gloss);

/// The candidates for a place. A token without stroke, without motion, or outside its motion is none; asked for by
/// number it is an error that says why. Throws Error{not_found} with near matches for a gloss that the database lacks.
std::vector<Candidate> candidates_for(const Contents& contents, const Place& place);

/// A run of neighbouring signs of one recording, in time order, as one candidate, from its first sign with a stroke to
/// its last. None where no sign has a stroke inside the motion.
std::optional<Candidate> candidate_of_run(const Contents& contents, std::size_t recording, std::vector<Sign> signs);

/// Makes `last` go on with the signs of `next`, which was recorded after it (`are_neighbours`): one clip, with the
/// recorded transition inside.
void extend_with(Candidate& last, const Candidate& next);

}  // namespace signweave
