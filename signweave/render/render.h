#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "signweave/render/junction.h"
#include "signweave/render/laid.h"
#include "signweave/score/result.h"

namespace signweave {

/// Where everything will lie: Algorithm 1 before any frame is made. Stretches are borrowed.
struct Plan {
  std::vector<Laid> laid;
  std::vector<JunctionCuts> cuts;  ///< [stretch − 1]
  std::vector<bool> aligned;       ///< [stretch] brought to where the reference's signer stands
  std::size_t reference = 0;       ///< the stretch whose signer stands where all are brought
  std::int64_t frames = 0;
};

/// Makes what a plan says: the frames of `out.motion` with their scalar tracks, `out.sources`, `out.stretches` and
/// `out.junctions`. Decides nothing. The memory of what `out` was is used again. Throws Error{corrupt}.
void render(const Plan& plan, const JunctionSettings& settings, Synthesis& out);

}  // namespace signweave
