#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/motion/skeleton.h"
#include "signweave/rig/part.h"

namespace signweave {

/// [joint] names as they are compared: lower case, without a namespace (`mixamorig:`), without what most of the joints
/// begin with (`Character1_`, `Bip01 `), without separators.
std::vector<std::string> plain_names(const Skeleton& skeleton);

/// What names alone say.
struct NameMatch {
  std::array<JointIndex, kPartCount> joints;  ///< kNoJoint where no name tells
  std::string convention;                     ///< empty: no table fits
  std::vector<Part> ambiguous;                ///< parts whose name several joints bear; the first was taken
};
NameMatch match_names(const Skeleton& skeleton);

}  // namespace signweave
