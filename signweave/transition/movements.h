#pragma once

#include <cstddef>
#include <vector>

#include "signweave/motion/motion.h"
#include "signweave/transition/residual.h"

namespace signweave {

/// Captured movements of a motion, to learn from: of each wrist from speed valley to speed valley, and stretches of
/// 0.4 to 1.1 s about its fastest moments. Of one length none holds a frame of another; at most `most`, evenly from
/// all, by their first frame. Frames that are no numbers are in none.
std::vector<FrameRange> captured_movements(const Motion& motion, const JointGroups& groups, std::size_t most,
                                           ArmScratch& scratch);

/// What they say, each as residual_span has it.
std::vector<ResidualSpan> residual_spans(const Motion& motion, const JointGroups& groups,
                                         const std::vector<FrameRange>& movements, std::size_t fold);

}  // namespace signweave
