#pragma once

#include "signweave/rig/rig_map.h"

namespace signweave {

/// Removes parts from a map that names placed anatomically impossibly, such as a hand that is not beyond its forearm.
/// Parts set by a mapping file stay.
void drop_impossible_parts(const Skeleton& skeleton, RigMap& map);

/// Throws Error{bad_input} if a mapping file puts a part of a limb, or the head, before the part from which it grows.
void require_possible_parts(const Skeleton& skeleton, const RigMap& map);

}  // namespace signweave
