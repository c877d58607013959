#pragma once

#include "signweave/render/plan.h"
#include "signweave/score/result.h"

namespace signweave {

/// Makes what a score says, of the stretches that stretches_of or whoever made the score has: all of `out` but its
/// notices and declarations. Decides nothing. The memory of what `out` was is used again. Throws Error{bad_input} as
/// plan_of, Error{corrupt}.
void render(const Score& score, const std::vector<Stretch>& stretches, const JunctionSettings& settings,
            Synthesis& out);

}  // namespace signweave
