#pragma once

#include <string>
#include <vector>

#include "signweave/retarget/recorded_body.h"

namespace signweave {

/// Whether the signing of one recording may be retargeted to the body of another, decided from both rig maps.
struct BodyMatch {
  std::vector<std::string> unsafe;       ///< one clause per obstacle: "'b' has no left_hand"; empty: it is safe
  std::vector<std::string> approximate;  ///< one line for each aspect that is not transferred as captured
};

/// Compares two bodies. Hands carry the signs, so they are transferred completely or not at all. It is unsafe if either
/// body lacks its trunk or its shoulders, if one has an arm that the other lacks, if the mapping of an arm part or a
/// finger is a guess (confidence below kSurePart), and if the source lacks some fingers of a hand that the target has,
/// while having others: that would produce a handshape that was never signed. A hand without any fingers stays still,
/// and this is reported.
BodyMatch match_bodies(const RecordedBody& source, const RecordedBody& target);

/// The minimum confidence of an arm part or a finger; below it, left and right are guesses.
inline constexpr float kSurePart = 0.35f;

}  // namespace signweave
