#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "signweave/rig/body_shape.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

/// One thing on the body that tells left from right.
struct SideCue {
  std::string_view what;  ///< "the feet point forward", …
  float score = 0;        ///< in [-1, 1]: 1 the sides are as the map has them, -1 they are the other way round
};

/// What tells left from right in the captured frames, given a map. Feet, knees, eyes and jaw tell where the body looks,
/// bent elbows too; fingers bend towards the palm, and with the thumb's side that makes a left or a right hand.
std::vector<SideCue> side_cues(const BodyShape& shape, const RigMap& map);

/// All cues together, in [-1, 1]; 0 where nothing tells.
float sides_score(const std::vector<SideCue>& cues);

}  // namespace signweave
