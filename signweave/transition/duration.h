#pragma once

#include "signweave/core/time.h"
#include "signweave/features/duration_fit.h"
#include "signweave/transition/gap.h"

namespace signweave {

/// Measures the task of a transition from the borders of its gap; values that cannot be measured on this body are
/// unknown. Velocities are taken over kTaskContext before the left border and after the right one.
TransitionTask task_of(const Gap& gap, const SignerModel& signer);
inline constexpr Seconds kTaskContext{0.05};

}  // namespace signweave
