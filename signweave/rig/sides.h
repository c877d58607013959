#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "signweave/rig/body_shape.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

/// A feature of the body that distinguishes left from right.
struct SideCue {
  std::string_view what;  ///< "the feet point forward", …
  float score = 0;        ///< in [-1, 1]: 1 if the map's sides are right, -1 if they are swapped
};

/// The cues that distinguish left from right in the captured frames, given a map. Feet, knees, eyes, jaw and bent
/// elbows show which direction the body faces; fingers bend towards the palm, which together with the thumb's side
/// identifies a left or right hand.
std::vector<SideCue> side_cues(const BodyShape& shape, const RigMap& map);

/// All cues combined, in [-1, 1]; 0 if no cue is conclusive.
float sides_score(const std::vector<SideCue>& cues);

}  // namespace signweave
