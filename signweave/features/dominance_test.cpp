#include "signweave/features/dominance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "signweave/features/phase_features.h"
#include "signweave/rig/test_rig.h"

namespace signweave {
namespace {

TEST(Dominance, IsTheHandOfOneHandedStrokes) {
  const std::vector<StrokePaths> strokes = {{0.5f, 0.5f}, {0.02f, 0.3f}, {0.4f, 0.45f}, {0.01f, 0.2f}};
  const Dominance right = dominance_of(strokes);
  EXPECT_EQ(right.hand, Side::right);
  EXPECT_NEAR(right.score, (0.5f - 0.03f) / 0.53f, 1e-5f);
  EXPECT_EQ(right.strokes, 2U);
  EXPECT_EQ(name_of(right), "right");
  std::vector<StrokePaths> other;
  for (const StrokePaths& stroke : strokes) other.push_back({stroke.right, stroke.left});
  EXPECT_EQ(dominance_of(other).hand, Side::left);
  EXPECT_EQ(dominance_of(other).score, -right.score);
}

TEST(Dominance, IsUnknownIfBothHandsMoveAlikeOrNoneDoes) {
  EXPECT_EQ(dominance_of(std::vector<StrokePaths>{{0.5f, 0.52f}, {0.3f, 0.29f}}).hand, std::nullopt);
  EXPECT_EQ(dominance_of(std::vector<StrokePaths>{{0.001f, 0.04f}}).hand, std::nullopt);
  EXPECT_EQ(name_of(dominance_of({})), "unknown");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(dominance_of(std::vector<StrokePaths>{{nan, 1}, {0, 0.3f}}).strokes, 1U);
}

TEST(Dominance, CountsSignsThatAreAnnotatedForOneHand) {
  EXPECT_EQ(dominance_of({}, {.left = 12, .right = 3}).hand, Side::left);
  EXPECT_EQ(dominance_of({}, {.left = 5, .right = 3}).hand, std::nullopt);
  const std::vector<StrokePaths> right = {{0, 0.3f}};
  EXPECT_EQ(dominance_of(right, {.left = 8, .right = 2}).score, 0.5f * (1.0f - 0.6f));
}

/// The left arm waves, the right one in the last of three seconds only.
Motion waving() {
  Motion motion(whole_person(), {100, 1}, 300);
  const auto wave = [&](const char* arm, std::int64_t from) {
    const auto joint = static_cast<std::size_t>(*motion.skeleton().find(arm));
    for (std::int64_t frame = from; frame < 300; ++frame) {
      motion.pose(frame).rotations[joint] =
          Eigen::AngleAxisf(0.5f * std::sin(0.08f * static_cast<float>(frame - from)), Eigen::Vector3f::UnitZ());
    }
  };
  wave("LeftArm", 0);
  wave("RightArm", 200);
  return motion;
}

TEST(Dominance, PathsAreThoseOfTheStrokesOrOfTheWholeMotion) {
  const Motion motion = waving();
  const HandTrace trace = trace_hands(motion, model_of(motion));
  const HandMotion measured = measure_hands(motion, model_of(motion), {0, 300});
  double path = 0;
  for (std::size_t i = 40; i < 160; ++i) path += double{measured.hands[0].frames[i].velocity.norm()} * 0.01;
  const std::vector<FrameRange> strokes = {{40, 160}, {-50, 20}, {250, 999}};
  const std::vector<StrokePaths> paths = paths_in(trace, strokes);
  ASSERT_EQ(paths.size(), 3U);
  EXPECT_NEAR(paths[0].left, path, 0.02 * path);
  EXPECT_LT(paths[0].right, 0.001f);
  EXPECT_GT(paths[2].right, 0.05f);
  EXPECT_EQ(paths_in(trace).size(), 6U);
  EXPECT_EQ(dominance_of(paths_in(trace)).hand, Side::left);
  const Motion other = in_mirror(motion);
  EXPECT_EQ(dominance_of(paths_in(trace_hands(other, model_of(other)))).hand, Side::right);
}

}  // namespace
}  // namespace signweave
