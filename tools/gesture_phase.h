#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "signweave/features/segmenter.h"

namespace signweave {

/// A recording in which a person labelled the phase of the hands at every moment.
struct LabelledTrack {
  std::string name;  ///< "a1": user A, story 1
  UpperBodyTrack track;
  std::vector<MotionPhase> labels;  ///< one per time

  /// The person recorded: the name's first letter.
  char user() const { return name.empty() ? '?' : name.front(); }
};

/// One raw file of the data set "Gesture Phase Segmentation" (Madeo, Wagner, Peres 2014): 18 coordinates, milliseconds,
/// label. x and y are in a unit of their own and y points down; the distance from head to spine is taken as 0.47 m.
/// Throws Error{not_found} or Error{bad_input} with file and line.
LabelledTrack read_gesture_phase(const std::filesystem::path& path);

/// All files of a folder (its raw/ contains *_raw.csv), by name. Throws Error{not_found} if there are none.
std::vector<LabelledTrack> read_gesture_phases(const std::filesystem::path& folder);

}  // namespace signweave
