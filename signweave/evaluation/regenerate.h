#pragma once

#include <cstdint>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/motion/motion.h"
#include "signweave/transition/body_guard.h"
#include "signweave/transition/method.h"

namespace signweave {

/// The gap that is left when frames are cut out of a motion, and `count` are to be made in their place; a side is seen
/// as far as kContext and the motion go. Borrowed from the motion. At least one frame must lie on either side.
Gap gap_at(const Motion& motion, const JointGroups& groups, FrameRange frames, std::int64_t count);

/// Makes gaps anew, one after the other, in memory that is used again.
class Regenerator {
 public:
  struct Made {
    PosesView poses;           ///< borrowed until the next call
    std::int64_t changed = 0;  ///< frames beside the gap that the method wrote to, of kGuard on either side
    double microseconds = 0;   ///< that the method took
  };
  /// With a guard as `sign` has it: hands that a method leads through the body are led around it.
  Made make(const GapMethod& method, const Gap& gap, const TransitionModel& model, BodyGuard* guard = nullptr);

  static constexpr std::int64_t kGuard = 4;

 private:
  GapScratch scratch_;
  std::vector<Eigen::Quaternionf> rotations_;
  std::vector<Eigen::Vector3f> translations_;
};

}  // namespace signweave
