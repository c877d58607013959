#pragma once

#include "signweave/core/time.h"
#include "signweave/features/duration_fit.h"
#include "signweave/transition/gap.h"

namespace signweave {

/// From the borders of a gap; what cannot be measured of this body is not known. Velocities are those over kTaskContext
/// before the left border and after the right one.
TransitionTask task_of(const Gap& gap, const SignerModel& signer);
inline constexpr Seconds kTaskContext{0.05};

}  // namespace signweave
