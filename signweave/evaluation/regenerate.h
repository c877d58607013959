#pragma once

#include <cstdint>

#include "signweave/core/time.h"
#include "signweave/features/capture_noise.h"
#include "signweave/motion/motion.h"
#include "signweave/render/junction.h"
#include "signweave/transition/method.h"

namespace signweave {

/// The gap that is left when frames are cut out of a motion, and `count` are to be made in their place; a side is seen
/// as far as kContext and the motion go. Borrowed from the motion. At least one frame must lie on either side.
Gap gap_at(const Motion& motion, const JointGroups& groups, FrameRange frames, std::int64_t count);

/// Frames that are cut out of a motion, and made anew. Borrowed.
struct CutOut {
  const Motion& motion;    ///< neighbours in one hemisphere
  FrameRange frames;       ///< at least one frame lies on either side
  std::int64_t count = 0;  ///< that are made in their place
  const CaptureNoise* noise = nullptr;
};

/// Makes gaps anew, one after the other, in memory that is used again: each as the one made gap of a score, by what
/// renders scores.
class Regenerator {
 public:
  /// What the settings point to must outlive it; their method is not looked at.
  explicit Regenerator(const JunctionSettings& settings) : filler_(settings) {}

  struct Made {
    PosesView poses;           ///< borrowed until the next call
    std::int64_t changed = 0;  ///< frames beside the gap that were written to, of kGuard on either side
    double microseconds = 0;   ///< that making them took
  };
  Made make(const GapMethod& method, const CutOut& cut);

  static constexpr std::int64_t kGuard = 4;

 private:
  JunctionFiller filler_;
  JunctionScratch scratch_;
  Motion window_;
};

}  // namespace signweave
