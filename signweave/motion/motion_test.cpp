#include "signweave/motion/motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3f;

std::shared_ptr<const Skeleton> arm() {
  return std::make_shared<const Skeleton>(
      std::vector<Joint>{
          {"Hips", kNoJoint, {0, 1, 0}, true}, {"Arm", 0, {1, 0, 0}, false}, {"Hand", 1, {2, 0, 0}, true}},
      std::vector<Tip>{});
}

/// The numbers identify frame f: the root is at x = f, the arm is turned f/10 about y.
Motion counted(std::int64_t frames) {
  Motion motion(arm(), {100, 1});
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const MutablePoseView pose = motion.append();
    const auto number = static_cast<float>(frame);
    pose.translations[0].x() = number;
    pose.rotations[1] = AngleAxisf(0.1f * number, Vector3f::UnitY());
  }
  return motion;
}

TEST(Motion, BeginsAtRest) {
  const Motion motion(arm(), {100, 1}, 3);
  ASSERT_EQ(motion.frame_count(), 3);
  const PoseView pose = motion.pose(2);
  for (const Quaternionf& rotation : pose.rotations) EXPECT_EQ(rotation.coeffs(), Quaternionf::Identity().coeffs());
  EXPECT_THAT(pose.translations, testing::ElementsAre(Vector3f(0, 1, 0), Vector3f(2, 0, 0)));
}

TEST(Motion, LastsItsFramesTimesTheFrameTime) {
  EXPECT_DOUBLE_EQ(Motion(arm(), {100, 1}, 250).duration().count(), 2.5);
  EXPECT_DOUBLE_EQ(Motion(arm(), {30000, 1001}, 30).duration().count(), 1.001);
  EXPECT_DOUBLE_EQ(Motion().duration().count(), 0);
}

TEST(Motion, AppendsAFrameOfItsOwn) {
  Motion motion = counted(3);
  for (int i = 0; i < 100; ++i) motion.append(motion.pose(2));  // as in a hold; the storage moves meanwhile
  ASSERT_EQ(motion.frame_count(), 103);
  for (std::int64_t frame = 2; frame < 103; ++frame) {
    EXPECT_EQ(motion.pose(frame).translations[0].x(), 2) << frame;
    EXPECT_EQ(motion.pose(frame).rotations[1].coeffs(), motion.pose(2).rotations[1].coeffs()) << frame;
  }
}

TEST(Slice, HasTheBitsOfItsFramesAndTheirPartOfEveryTrack) {
  Motion motion = counted(10);
  motion.add_track({"jaw", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}});
  const Motion part = motion.slice({3, 7});
  ASSERT_EQ(part.frame_count(), 4);
  EXPECT_EQ(part.rate(), motion.rate());
  EXPECT_EQ(part.shared_skeleton(), motion.shared_skeleton());
  for (std::int64_t frame = 0; frame < 4; ++frame) {
    EXPECT_EQ(part.pose(frame).translations[0].x(), static_cast<float>(frame + 3));
    EXPECT_EQ(part.pose(frame).rotations[1].coeffs(), motion.pose(frame + 3).rotations[1].coeffs());
  }
  EXPECT_THAT(part.tracks(), testing::ElementsAre(ScalarTrack{"jaw", {3, 4, 5, 6}}));
}

TEST(Slice, MayBeEmptyOrWhole) {
  const Motion motion = counted(4);
  EXPECT_EQ(motion.slice({2, 2}).frame_count(), 0);
  EXPECT_EQ(motion.slice({4, 4}).frame_count(), 0);
  EXPECT_EQ(motion.slice({0, 4}).frame_count(), 4);
}

TEST(Slice, OutlivesTheMotionItWasCutFrom) {
  Motion part;
  {
    const Motion motion = counted(4);
    part = motion.slice({1, 3});
  }
  EXPECT_EQ(part.pose(0).translations[0].x(), 1);
  EXPECT_EQ(part.skeleton().joint(2).name, "Hand");
}

TEST(Pose, IsAtRestUntilFilled) {
  const std::shared_ptr<const Skeleton> skeleton = arm();
  const Pose pose(*skeleton);
  EXPECT_THAT(pose.translations, testing::ElementsAre(Vector3f(0, 1, 0), Vector3f(2, 0, 0)));
  EXPECT_EQ(pose.rotations.size(), 3U);
}

TEST(KeepHemisphere, ChangesNoRotationAndLeavesNeighboursInOneHemisphere) {
  Motion motion = counted(40);
  for (std::int64_t frame = 0; frame < 40; frame += 3) motion.pose(frame).rotations[1].coeffs() *= -1;
  const Motion before = motion;
  keep_hemisphere(motion);
  for (std::int64_t frame = 0; frame < 40; ++frame) {
    const Quaternionf now = motion.pose(frame).rotations[1];
    EXPECT_EQ(now.toRotationMatrix(), before.pose(frame).rotations[1].toRotationMatrix());
    const Quaternionf neighbour = motion.pose(std::max<std::int64_t>(frame - 1, 0)).rotations[1];
    EXPECT_GT(now.dot(neighbour), 0) << frame;
  }
  // The other frames follow the first one.
  EXPECT_EQ(motion.pose(0).rotations[1].coeffs(), before.pose(0).rotations[1].coeffs());
}

}  // namespace
}  // namespace signweave
