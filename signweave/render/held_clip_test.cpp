#include "signweave/render/held_clip.h"

#include <gtest/gtest.h>

#include <memory>

#include "signweave/motion/motion_source.h"
#include "signweave/score/test_motion.h"

namespace signweave {
namespace {

MotionClip clip_of_a_longer_motion() {
  return {.recording = "r",
          .source = std::make_shared<MemorySource>(testing_motion::moving(120, {100, 1}, 1)),
          .whole = {3, 85},
          .core = {10, 59},
          .clock = {},
          .signs = {}};
}

// Between its last frame and the one after it a clip is interpolated, whatever is held.
TEST(HeldClip, OtherFramesKeepTheirBits) {
  const MotionClip clip = clip_of_a_longer_motion();
  for (const double step : {1.0, 1.3, 13.0 / 3}) {
    PlacedClip placed = placed_by_step(clip, step);
    placed.core = 100;
    placed.after = placed.retraction;
    for (const HeldFrames held : {HeldFrames{.before = 7}, HeldFrames{.before = 50}, HeldFrames{.at_end = 9}}) {
      const HeldClip made = hold(placed, held);
      const FrameRange shown{placed.core - placed.preparation, placed.core_end() + placed.retraction};
      Motion before(clip.source->skeleton(), clip.source->rate(), shown.size());
      Motion after = before;
      read_frames(placed, shown, before.poses({0, shown.size()}));
      read_frames(made.placed, shown, after.poses({0, shown.size()}));
      EXPECT_TRUE(same_bits(before, after)) << "step " << step << ", held before " << held.before;
    }
  }
}

}  // namespace
}  // namespace signweave
