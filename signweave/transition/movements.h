#pragma once

#include <cstddef>
#include <vector>

#include "signweave/motion/motion.h"
#include "signweave/transition/residual.h"

namespace signweave {

/// Captured movements of a motion, to learn from: of each wrist from speed valley to speed valley, and spans of 0.4 to
/// 1.1 s around its fastest moments. Spans of the same length do not overlap. Returns at most `most`, evenly chosen, in
/// order of their first frame. Frames with non-finite values are in none.
std::vector<FrameRange> captured_movements(const Motion& motion, const JointGroups& groups, std::size_t most,
                                           ArmScratch& scratch);

/// The residual spans of these movements, see residual_span.
std::vector<ResidualSpan> residual_spans(const Motion& motion, const JointGroups& groups,
                                         const std::vector<FrameRange>& movements, std::size_t fold);

}  // namespace signweave
