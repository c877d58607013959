#pragma once

#include <cstdint>

#include "signweave/core/time.h"
#include "signweave/features/capture_noise.h"
#include "signweave/motion/motion.h"
#include "signweave/render/junction.h"
#include "signweave/transition/method.h"

namespace signweave {

/// The gap that is left when `frames` are cut out of a motion and `count` frames are to be generated instead. Each side
/// has at most kContext, limited by the motion. Borrowed from the motion. There must be at least one frame on either
/// side.
Gap gap_at(const Motion& motion, const JointGroups& groups, FrameRange frames, std::int64_t count);

/// Frames that are cut out of a motion and regenerated. Borrowed.
struct CutOut {
  const Motion& motion;    ///< neighbours in one hemisphere
  FrameRange frames;       ///< at least one frame is on either side
  std::int64_t count = 0;  ///< number of frames generated instead
  const CaptureNoise* noise = nullptr;
};

/// Regenerates gaps one after the other, reusing memory: each as the only gap of a score, with the renderer of scores.
class Regenerator {
 public:
  /// Everything that the settings point to must outlive it; their method is ignored.
  explicit Regenerator(const JunctionSettings& settings) : filler_(settings) {}

  struct Made {
    PosesView poses;           ///< borrowed until the next call
    std::int64_t changed = 0;  ///< number of modified frames next to the gap, of kGuard on either side
    double microseconds = 0;   ///< time taken to generate them
  };
  Made make(const GapMethod& method, const CutOut& cut);

  static constexpr std::int64_t kGuard = 4;

 private:
  JunctionFiller filler_;
  JunctionScratch scratch_;
  Motion window_;
};

}  // namespace signweave
