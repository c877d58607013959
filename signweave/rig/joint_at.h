#pragma once

#include <cstddef>

#include "signweave/motion/skeleton.h"

namespace signweave {

/// A joint as the place in lists of all joints; it must be one.
constexpr std::size_t at(JointIndex joint) {
  return static_cast<std::size_t>(joint);
}

}  // namespace signweave
