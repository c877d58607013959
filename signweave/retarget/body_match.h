#pragma once

#include <string>
#include <vector>

#include "signweave/retarget/recorded_body.h"

namespace signweave {

/// Whether the signing of one recording may be put onto the body of another, told from both rig maps.
struct BodyMatch {
  std::vector<std::string> unsafe;       ///< what forbids it, a clause each: "'b' has no left_hand"; empty: it is safe
  std::vector<std::string> approximate;  ///< what does not come over as it was captured, a line each
};

/// Hands carry the signs, so they come over whole or not at all. It is not safe where either body lacks its trunk or
/// its shoulders, where one has an arm that the other lacks, where a part of an arm or a finger is a guess (below
/// kSurePart), and where the source has some fingers of a hand but not others that the target has: that would show a
/// handshape that nobody made. A hand without any fingers keeps still, and that is told.
BodyMatch match_bodies(const RecordedBody& source, const RecordedBody& target);

/// The confidence below which a part of an arm or of a finger is not believed: left and right are guessed there.
inline constexpr float kSurePart = 0.35f;

}  // namespace signweave
