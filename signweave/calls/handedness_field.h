#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signweave/calls/field.h"
#include "signweave/core/error.h"
#include "signweave/motion/motion.h"
#include "signweave/rig/rig_map.h"

namespace signweave::calls {

inline Field handedness_field() {
  return {.name = "handedness",
          .help =
              "the dominant hand of the signer shown: left or right; recordings of signers with the other one are "
              "mirrored. As captured if not given",
          .one_of = {"left", "right"}};
}

/// Requires a checked field. None if it is empty.
std::optional<Side> side_of(const std::string& handedness);

/// Returns a motion whose signer's dominant hand is `hand`: mirrored if the paths of its palms show that it is the
/// other one. Adds what was found to `notices`, about `recording`. Throws Error{bad_input} if the signer cannot be
/// mirrored (mirroring_of).
Motion with_handedness(Motion motion, Side hand, const std::string& recording, const RigNames& rig,
                       std::vector<Notice>& notices);

}  // namespace signweave::calls
