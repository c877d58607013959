// Tests of the baselines, which only the evaluation offers.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "signweave/motion/blend.h"
#include "signweave/transition/method.h"

namespace signweave {
namespace {

constexpr std::size_t kJoints = 2;

/// A root that moves and rotates by given functions, and a rotating joint.
template <class PositionAt, class Turn>
Motion arm_motion(std::int64_t frames, PositionAt place, Turn turn) {
  const auto skeleton = std::make_shared<const Skeleton>(
      std::vector<Joint>{{"Hips", kNoJoint, {0, 1, 0}, true}, {"Arm", 0, {0.3f, 0, 0}, false}}, std::vector<Tip>{});
  Motion motion(skeleton, {100, 1}, frames);
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const auto f = static_cast<float>(frame);
    motion.pose(frame).translations[0] = {place(f), 1, 0};
    motion.pose(frame).rotations[1] = Eigen::AngleAxisf(turn(f), Eigen::Vector3f(0.6f, 0, 0.8f));
  }
  return motion;
}

JointGroups one_arm_groups() {
  JointGroups groups;
  groups.of = {JointGroup::body, JointGroup::left_arm};
  groups.all[0] = {0};
  groups.all[1] = {1};
  groups.of_translation = {JointGroup::body};
  return groups;
}

struct FilledArm {
  std::vector<Eigen::Quaternionf> rotations;
  std::vector<Eigen::Vector3f> translations;
  const Eigen::Quaternionf& arm(std::size_t frame) const { return rotations[frame * kJoints + 1]; }
};

FilledArm fill_arm(const char* name, const Motion& motion, FrameRange frames, GroupSet set = GroupSet::all()) {
  const JointGroups of = one_arm_groups();
  const Gap gap{.skeleton = &motion.skeleton(),
                .groups = &of,
                .rate = motion.rate(),
                .before = view_of(motion, {frames.begin - 31, frames.begin}),
                .after = view_of(motion, {frames.end, frames.end + 31}),
                .count = frames.size()};
  const auto count = static_cast<std::size_t>(frames.size());
  FilledArm filled{std::vector<Eigen::Quaternionf>(count * kJoints, Eigen::Quaternionf(0, 0, 0, 1)),
                   std::vector<Eigen::Vector3f>(count, Eigen::Vector3f(7, 7, 7))};
  GapScratch scratch;
  const GapMethod* method = find_gap_method(name);
  if (method == nullptr) throw std::runtime_error(name);
  method->fill({.gap = gap, .model = default_transition_model(), .groups = set, .scratch = scratch},
               {filled.rotations, filled.translations});
  return filled;
}

float small_angle(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b) {
  return 2 * std::asin(std::min(1.0f, (a.conjugate() * b).vec().norm()));
}

TEST(Baselines, BothAreExactAtConstantSpeed) {
  const Motion motion = arm_motion(
      100, [](float f) { return 0.01f * f; }, [](float f) { return 0.02f * f; });
  for (const char* const name : {"crossfade", "recipe"}) {
    const FilledArm filled = fill_arm(name, motion, {40, 60});
    for (std::size_t i = 0; i < 20; ++i) {
      const PoseView captured = motion.pose(40 + static_cast<std::int64_t>(i));
      EXPECT_LT(small_angle(filled.arm(i), captured.rotations[1]), 1e-3f) << name << ' ' << i;
      EXPECT_LT((filled.translations[i] - captured.translations[0]).norm(), 1e-4f) << name << ' ' << i;
    }
  }
}

TEST(Baselines, ACrossFadeContinuesEachSideAsFarAsItIsKnown) {
  // Before: moving; after: still at 1. The first side dominates in the first frames, the second in the last ones.
  const Motion motion = arm_motion(
      200, [](float f) { return f <= 60 ? 0.01f * f : 1.0f; }, [](float) { return 0.0f; });
  const FilledArm filled = fill_arm("crossfade", motion, {60, 120});
  const float left = 0.59f;
  for (std::size_t i = 0; i < 60; ++i) {
    const float t = static_cast<float>(i + 1) / 61;
    const float gone = left + 0.01f * std::min(static_cast<float>(i + 1), 30.0f);
    EXPECT_NEAR(filled.translations[i].x(), gone + t * (1 - gone), 1e-4f) << i;
  }
}

TEST(Baselines, TheRecipeCutsAtTheMostSimilarPoses) {
  // The arm goes up by 0.9 and down again by 0.6, so that the most similar frames are 30 frames before the left border
  // (0.6 up) and the right border (0.3 up).
  const auto turn = [](float f) { return f < 90 ? 0.01f * f : 0.9f - 0.02f * (f - 90); };
  const Motion motion = arm_motion(
      200, [](float) { return 0.0f; }, turn);
  const FilledArm filled = fill_arm("recipe", motion, {90, 120});
  // From 0.59 (30 frames before frame 89) to 0.3 (frame 120) in 61 steps; the filter does not change the inside of a
  // straight line.
  for (std::size_t i = 1; i + 1 < 30; ++i) {
    const float wanted = 0.59f + (0.3f - 0.59f) * static_cast<float>(31 + i) / 61;
    EXPECT_NEAR(small_angle(Eigen::Quaternionf::Identity(), filled.arm(i)), wanted, 2e-3f) << i;
  }
  // The first generated frame is the mean of the border, itself and the next.
  const float second = 0.59f + (0.3f - 0.59f) * 32.0f / 61;
  const float first = 0.59f + (0.3f - 0.59f) * 31.0f / 61;
  EXPECT_NEAR(small_angle(Eigen::Quaternionf::Identity(), filled.arm(0)), (0.89f + first + second) / 3, 2e-3f);
}

TEST(Baselines, OtherGroupsAreUnchanged) {
  const Motion motion = arm_motion(
      100, [](float f) { return 0.01f * f; }, [](float f) { return 0.02f * f; });
  for (const char* const name : {"crossfade", "recipe"}) {
    const FilledArm arm = fill_arm(name, motion, {40, 50}, {JointGroup::left_arm});
    EXPECT_EQ(arm.translations[3], Eigen::Vector3f(7, 7, 7)) << name;
    EXPECT_EQ(arm.rotations[3 * kJoints].z(), 1) << name;
    const FilledArm body = fill_arm(name, motion, {40, 50}, {JointGroup::body});
    EXPECT_EQ(body.arm(3).z(), 1) << name;
    EXPECT_NE(body.translations[3], Eigen::Vector3f(7, 7, 7)) << name;
  }
}

TEST(Baselines, QuaternionsContinueInTheLeftBordersHemisphere) {
  Motion motion = arm_motion(
      100, [](float f) { return 0.01f * f; }, [](float f) { return 0.02f * f; });
  for (std::int64_t frame = 50; frame < 100; ++frame) motion.pose(frame).rotations[1].coeffs() *= -1;
  for (const char* const name : {"crossfade", "recipe"}) {
    const FilledArm filled = fill_arm(name, motion, {40, 50});
    for (std::size_t i = 0; i < 10; ++i) EXPECT_GT(filled.arm(i).dot(motion.pose(39).rotations[1]), 0) << name;
  }
}

}  // namespace
}  // namespace signweave
