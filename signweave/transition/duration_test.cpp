#include "signweave/transition/duration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "signweave/rig/test_rig.h"

namespace signweave {
namespace {

TEST(Tasks, DescribeTheMovementOfTheHands) {
  // The left arm swings at constant speed; the right one is still. Between is a gap of 20 unknown frames.
  const auto skeleton = whole_person();
  Motion motion(skeleton, {100, 1}, 80);
  const auto arm = static_cast<std::size_t>(*skeleton->find("LeftArm"));
  for (std::int64_t frame = 0; frame < 80; ++frame) {
    motion.pose(frame).rotations[arm] =
        Eigen::AngleAxisf(0.01f * static_cast<float>(frame - 40), Eigen::Vector3f::UnitY());
  }
  SignerModel signer{.rig = rig_of_signer(*skeleton), .body = {}};
  signer.body = signer_body(motion, signer.rig);
  const JointGroups groups = joint_groups(*skeleton, signer.rig);
  const Gap gap{.skeleton = skeleton.get(),
                .groups = &groups,
                .rate = motion.rate(),
                .before = view_of(motion, {0, 30}),
                .after = view_of(motion, {50, 80}),
                .count = 20};
  const TransitionTask task = task_of(gap, signer);
  const HandTask& left = task.hands[static_cast<std::size_t>(Side::left)];
  const HandTask& right = task.hands[static_cast<std::size_t>(Side::right)];
  ASSERT_TRUE(left.known && right.known);
  EXPECT_FLOAT_EQ(task.shoulder_width, signer.body->shoulder_width);
  EXPECT_LT(right.distance, 1e-5f);
  EXPECT_LT(right.speed_before, 1e-4f);
  EXPECT_LT(left.handshape_change, 1e-5f);
  const float radius = left.distance / (2.0f * std::sin(0.105f));
  EXPECT_GT(radius, 0.4f);
  EXPECT_LT(radius, 0.8f);
  EXPECT_NEAR(left.speed_before, radius * 1.0f, 0.01f);  // a radian a second
  EXPECT_NEAR(left.speed_after, radius * 1.0f, 0.01f);
  EXPECT_NEAR(left.approach, left.speed_before + left.speed_after, 0.05f);  // it continues in the same direction
}

}  // namespace
}  // namespace signweave
