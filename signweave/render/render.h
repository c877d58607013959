#pragma once

#include "signweave/render/plan.h"
#include "signweave/score/result.h"

namespace signweave {

/// Puts the captured frames of a plan's stretches where they lie, as they were captured, into `out`, which becomes as
/// long as the plan says. Returns the tracks that it had, for their memory. Throws Error{corrupt}.
std::vector<ScalarTrack> fetch(const Plan& plan, const JunctionSettings& settings, Motion& out);

/// Makes what a score says of its stretches, which stretches_of or the score's maker has: all of `out` but its
/// notices and declarations. Decides nothing. The memory of what `out` was is used again. Throws Error{bad_input} as
/// plan_of, Error{corrupt}.
void render(Score score, const std::vector<Stretch>& stretches, const JunctionSettings& settings, Synthesis& out,
            std::optional<std::vector<ScalarTrack>> fetched = std::nullopt);

}  // namespace signweave
