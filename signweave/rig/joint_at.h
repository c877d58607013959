#pragma once

#include <cstddef>

#include "signweave/motion/skeleton.h"

namespace signweave {

/// The index of a joint in lists of all joints; it must not be kNoJoint.
constexpr std::size_t at(JointIndex joint) {
  return static_cast<std::size_t>(joint);
}

}  // namespace signweave
