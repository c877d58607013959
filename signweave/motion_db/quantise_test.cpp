#include "signweave/motion_db/quantise.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "signweave/core/error.h"
#include "signweave/motion_db/grid.h"
#include "signweave/motion_db/test_compact.h"

namespace signweave::motion_db {
namespace {

TEST(Grid, LevelsAscendFourToTheOctave) {
  EXPECT_EQ(step_of(0), std::ldexp(1.0f, -30));
  EXPECT_EQ(step_of(4), std::ldexp(1.0f, -29));
  EXPECT_EQ(step_of(2), 1.5f * step_of(0));
  EXPECT_EQ(step_of(kCoarsestLevel), 0.125f);
  for (int level = 0; level < kCoarsestLevel; ++level) {
    EXPECT_LT(step_of(level), step_of(level + 1));
    EXPECT_EQ(level_below(step_of(level)), level);
    EXPECT_EQ(level_below(std::nextafter(step_of(level + 1), 0.0f)), level);
  }
  EXPECT_EQ(level_below(0.0f), 0);
  EXPECT_EQ(level_below(100.0f), kCoarsestLevel);
}

TEST(Grid, DroppedComponentsAreRestored) {
  for (int component = 0; component < 4; ++component) {
    for (const bool negative : {false, true}) {
      Eigen::Quaternionf q(0.5f, 0.5f, 0.5f, 0.5f);
      q.coeffs()[component] *= negative ? -1.0f : 1.0f;
      const Dropped dropped{component, negative};
      const auto kept = [&](int i) { return q.coeffs()[kept_component(dropped, i)]; };
      EXPECT_EQ(restored(dropped, kept(0), kept(1), kept(2)).coeffs(), q.coeffs());
    }
  }
}

RC_GTEST_PROP(Quantise, EveryJointAndTipStaysWithinTheToleranceInEveryFrame, ()) {
  const Motion motion = any_motion();
  const float tolerance = *rc::gen::elementOf(std::vector{1e-6f, 1e-5f, 1e-4f, 1e-3f, 0.05f});
  const Motion quantised = quantise(motion, tolerance);
  RC_ASSERT(quantised.frame_count() == motion.frame_count());
  RC_ASSERT(largest_distance(motion, quantised) <= static_cast<double>(tolerance));
  RC_ASSERT(keeps_hemisphere(quantised) || !keeps_hemisphere(motion));
}

TEST(Quantise, UsesMostOfTheTolerance) {
  std::mt19937 random(3);
  const Motion motion = random_motion(random, 12, 64, Manner::smooth);
  for (const float tolerance : {1e-5f, 1e-4f, 1e-3f}) {
    EXPECT_GT(largest_distance(motion, quantise(motion, tolerance)), 0.8 * static_cast<double>(tolerance));
  }
}

TEST(Quantise, AStillJointStaysStillWhenItsParentMoves) {
  // Parallel fingers on a turning arm, each with a different bend.
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  std::vector<Joint> joints{{.name = "arm"}};
  std::vector<Tip> tips;
  constexpr std::size_t kFingers = 40;
  for (std::size_t i = 1; i <= kFingers; ++i) {
    joints.push_back({.name = "finger", .parent = 0, .offset = Eigen::Vector3f(0.3f, 0, 0)});
    tips.push_back({.joint = static_cast<JointIndex>(i), .offset = Eigen::Vector3f(0.05f, 0, 0)});
  }
  Motion motion(std::make_shared<const Skeleton>(std::move(joints), std::move(tips)), FrameRate{60, 1}, 64);
  for (std::int64_t frame = 0; frame < 64; ++frame) {
    const float angle = 0.02f * static_cast<float>(frame);
    motion.pose(frame).rotations[0] = Eigen::AngleAxisf(angle, Eigen::Vector3f(1, 2, 3).normalized());
  }
  for (std::size_t i = 1; i <= kFingers; ++i) {
    const Eigen::Quaternionf bent = Eigen::Quaternionf(normal(random), normal(random), normal(random), 1).normalized();
    for (std::int64_t frame = 0; frame < 64; ++frame) motion.pose(frame).rotations[i] = bent;
  }
  const Motion quantised = quantise(motion, 1e-4f);
  for (std::int64_t frame = 0; frame < 64; ++frame) {
    const std::int64_t first = frame / kRunFrames * kRunFrames;
    for (std::size_t i = 1; i <= kFingers; ++i) {
      EXPECT_EQ(quantised.pose(frame).rotations[i].coeffs(), quantised.pose(first).rotations[i].coeffs());
    }
  }
}

TEST(Quantise, QuaternionsThatAreNotRotationsAreUnchanged) {
  const Motion motion = test_motion(40, 6);
  const Motion quantised = quantise(motion, 1e-3f);
  Motion turned = motion;
  keep_hemisphere(turned);
  EXPECT_EQ(std::memcmp(quantised.rotations().data(), turned.rotations().data(), turned.rotations().size_bytes()), 0);

  // This also holds if it has no children, so that no point reveals the rotation.
  Motion leaf(std::make_shared<const Skeleton>(std::vector<Joint>{{.name = "leaf"}}, std::vector<Tip>{}),
              FrameRate{60, 1}, 5);
  for (std::int64_t frame = 0; frame < 5; ++frame) leaf.pose(frame).rotations[0].coeffs() = {0.31f, 0.1f, 0.2f, 0.7f};
  EXPECT_TRUE(same_bits(quantise(leaf, 1e-3f), leaf));
}

TEST(Quantise, TracksAreUntouched) {
  const Motion motion = test_motion(40, 3, 1, 2);
  EXPECT_EQ(quantise(motion, 1e-3f).tracks(), motion.tracks());
}

TEST(Quantise, ReportsProgressAndCanBeCancelled) {
  const Motion motion = test_motion(3'000, 2);
  std::vector<double> seen;
  quantise(motion, 1e-3f, [&](double fraction) { seen.push_back(fraction); });
  ASSERT_GE(seen.size(), 3u);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.front(), 0.0);
  EXPECT_EQ(seen.back(), 1.0);
  struct Cancelled {};
  EXPECT_THROW(quantise(motion, 1e-3f,
                        [](double fraction) {
                          if (fraction > 0) throw Cancelled{};
                        }),
               Cancelled);
}

TEST(Quantise, AMotionWithoutFramesStaysEmpty) {
  EXPECT_EQ(quantise(test_motion(0), 1e-3f).frame_count(), 0);
}

TEST(Quantise, RefusesAToleranceThatIsNotALength) {
  for (const float tolerance : {0.0f, -1.0f, std::nanf(""), std::numeric_limits<float>::infinity()}) {
    EXPECT_THROW(quantise(test_motion(2), tolerance), Error) << tolerance;
  }
}

}  // namespace
}  // namespace signweave::motion_db
