#pragma once

#include "signweave/rig/rig_map.h"

namespace signweave {

/// Takes out of a map what names put where it cannot grow from what it grows from in a body: a hand that is not beyond
/// its forearm. What a mapping file says stays.
void drop_what_cannot_grow(const Skeleton& skeleton, RigMap& map);

/// Throws Error{bad_input} where a mapping file puts a part of a limb, or the head, before the one that it grows from.
void require_grown(const Skeleton& skeleton, const RigMap& map);

}  // namespace signweave
