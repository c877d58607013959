#pragma once

#include <optional>
#include <vector>

#include "signweave/choose/concatenate.h"

/// Inside this module only.
namespace signweave {

/// The settings of all junctions between some clips. Refers to the options and to itself.
struct JointSetup {
  /// Throws Error{bad_input} if there are no clips or their skeletons differ in more than offsets.
  JointSetup(const std::vector<MotionClip>& clips, const ConcatenateOptions& options);
  JointSetup(const JointSetup&) = delete;
  JointSetup& operator=(const JointSetup&) = delete;

  std::optional<SignerRig> measured;  ///< if the options have none
  JunctionSettings settings;
};

}  // namespace signweave
