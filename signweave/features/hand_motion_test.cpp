#include "signweave/features/hand_motion.h"

#include <gtest/gtest.h>

#include "signweave/rig/test_rig.h"

namespace signweave {
namespace {

TEST(MeasureHands, TellsWhyThereIsNothing) {
  const auto skeleton =
      std::make_shared<const Skeleton>(std::vector<Joint>{{"Hips", kNoJoint, {0, 1, 0}, true}}, std::vector<Tip>{});
  const Motion motion(skeleton, {60, 1}, 10);
  const RigMap rig = rig_of_signer(*skeleton);
  const HandMotion measured = measure_hands(motion, {.rig = rig, .body = signer_body(motion, rig)}, {0, 10});
  EXPECT_EQ(measured.hands[0].why_not, "no left shoulder: name it in a mapping file");
  EXPECT_TRUE(measured.hands[0].frames.empty());
  EXPECT_TRUE(measured.hands_distance.empty());
}

}  // namespace
}  // namespace signweave
