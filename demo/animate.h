#pragma once

#include "demo/plan.h"
#include "demo/signer.h"
#include "signweave/motion/motion.h"

namespace signweave::demo {

/// Makes the motion of a timeline with the tracks of its face: arms by inverse kinematics to the plan's wrists, hands
/// from handshape to handshape, a body that breathes, follows and looks, on feet that stand. `plan` is of `timeline`.
Motion animate(const Signer& signer, const Timeline& timeline, const HandPlan& plan, Random& random);

}  // namespace signweave::demo
