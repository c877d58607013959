// Retargeting a pose allocates nothing, because streams do it frame by frame.

#include <gtest/gtest.h>

#include <memory>

#include "signweave/core/test_allocations.h"
#include "signweave/retarget/retarget.h"
#include "signweave/retarget/retargeted_source.h"
#include "signweave/retarget/test_character.h"

namespace signweave {
namespace {

TEST(RetargetAllocations, NoneForAPose) {
  const Motion motion = moving(whole_person(), 20);
  const Character character = character_of(whole_person(0.9f));
  Retargeter retargeter(motion.skeleton(), plain_model_of(motion), character);
  Pose pose(*character.skeleton);
  EXPECT_EQ(allocations_in([&] {
              for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
                retargeter.pose(motion.pose(frame), pose.view());
              }
            }),
            0U);
}

TEST(RetargetAllocations, NoneForFramesOfAnotherSkeleton) {
  const auto motion = std::make_shared<MemorySource>(moving(whole_person(), 100));
  const MemorySource onto(moving(whole_person(0.9f), 100, 2));
  const RetargetedSource shown(
      motion, std::make_shared<const BodyMapping>(map_body(recorded_body("b", *motion), recorded_body("a", onto))));
  Motion out(shown.skeleton(), shown.rate(), 70);
  EXPECT_EQ(allocations_in([&] { shown.read({20, 90}, out.poses({0, 70})); }), 0U);
}

}  // namespace
}  // namespace signweave
