#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/motion/skeleton.h"
#include "signweave/rig/part.h"

namespace signweave {

/// [joint] the names in the form in which they are compared: lower case, without a namespace (`mixamorig:`), without
/// the prefix that most joints share (`Character1_`, `Bip01 `), without separators.
std::vector<std::string> plain_names(const Skeleton& skeleton);

/// The result of matching joint names only.
struct NameMatch {
  std::array<JointIndex, kPartCount> joints;  ///< kNoJoint if no name matches
  std::string convention;                     ///< empty if no table fits
  std::vector<Part> ambiguous;                ///< parts whose name several joints have; the first joint was taken
};
NameMatch match_names(const Skeleton& skeleton);

}  // namespace signweave
