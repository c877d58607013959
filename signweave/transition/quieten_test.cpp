// Tests that the noise of a capture does not enter generated frames.

#include "signweave/transition/quieten.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "signweave/transition/test_gap_motion.h"

namespace signweave {
namespace {

using namespace testing_gap;

/// The angle between a method's result in a noisy motion and the motion without noise, in degrees; the mean over
/// joints, frames and gaps.
double error_of(std::string_view method, double radians, bool known, double rate) {
  const JointGroups of = groups();
  GapScratch scratch;
  double sum = 0;
  std::size_t count = 0;
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  for (int seed = 0; seed < 5; ++seed) {
    const FrameRate hertz{static_cast<std::int32_t>(rate), 1};
    const Motion clean = lively(seed, hertz, static_cast<std::int64_t>(2 * rate));
    Motion shaken = clean;
    for (std::int64_t frame = 0; frame < shaken.frame_count(); ++frame) {
      for (Eigen::Quaternionf& q : shaken.pose(frame).rotations) {
        Eigen::Quaternionf turn(1, 0, 0, 0);
        turn.vec() =
            0.5f * static_cast<float>(radians) * Eigen::Vector3f(normal(random), normal(random), normal(random));
        q = (q * turn).normalized();
      }
    }
    CaptureNoise noise{std::vector<float>(testing_gap::kJoints, static_cast<float>(radians)), {0.0f}};
    const auto first = static_cast<std::int64_t>(0.8 * rate);
    Gap gap = cut(shaken, of, {first, first + static_cast<std::int64_t>(0.4 * rate)});
    if (known) gap.noise_before = gap.noise_after = &noise;
    const Filled made = fill(*find_gap_method(method), gap, TransitionModel{}, scratch);
    for (std::int64_t frame = 0; frame < gap.count; ++frame) {
      for (std::size_t joint = 0; joint < testing_gap::kJoints; ++joint) {
        if (of.roles[joint] == JointRole::finger) continue;  // fingers are brought to rest, but these keep swinging
        sum += static_cast<double>(made.at(frame, joint).angularDistance(clean.pose(first + frame).rotations[joint]));
        ++count;
      }
    }
  }
  return sum / static_cast<double>(count) * 180 / M_PI;
}

TEST(Quieten, ANoisyCaptureIsFollowedLikeACleanOne) {
  for (const double rate : {24.0, 30.0, 60.0, 100.0, 120.0}) {
    for (const double radians : {0.002, 0.005, 0.01}) {
      SCOPED_TRACE(testing::Message() << rate << " frames a second, " << radians);
      const double quiet = error_of("kriging", radians, true, rate);
      EXPECT_LT(quiet, error_of("kriging", radians, false, rate));
      // Little noise adds little to the method's error without noise.
      const double clean = error_of("kriging", 0, false, rate);
      EXPECT_LT(quiet, std::max(error_of("hermite", radians, false, rate), 1.3 * clean)) << "the cubic";
      EXPECT_LT(quiet, error_of("sine", radians, false, rate)) << "minimum jerk";
    }
  }
}

TEST(Quieten, WithoutNoiseNothingChanges) {
  const JointGroups of = groups();
  const Motion motion = lively(1);
  const CaptureNoise silent{std::vector<float>(testing_gap::kJoints, 0.0f), {0.0f}};
  for (const GapMethod& method : gap_methods()) {
    GapScratch scratch;
    Gap gap = cut(motion, of, {100, 140});
    const Filled plain = fill(method, gap, TransitionModel{}, scratch);

    gap.noise_before = gap.noise_after = &silent;
    const Filled with = fill(method, gap, TransitionModel{}, scratch);
    for (std::size_t i = 0; i < plain.rotations.size(); ++i) {
      ASSERT_EQ(plain.rotations[i].coeffs(), with.rotations[i].coeffs()) << method.name;
    }
  }
}

TEST(Quieten, GeneratedFramesStillMeetTheCapturedOnes) {
  const JointGroups of = groups();
  Motion motion = lively(2);
  const CaptureNoise noise{std::vector<float>(testing_gap::kJoints, 0.02f), {0.01f}};
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    for (Eigen::Quaternionf& q : motion.pose(frame).rotations) {
      Eigen::Quaternionf turn(1, 0, 0, 0);
      turn.vec() = 0.01f * Eigen::Vector3f(normal(random), normal(random), normal(random));
      q = (q * turn).normalized();
    }
  }
  GapScratch scratch;
  Gap gap = cut(motion, of, {100, 160});
  gap.noise_before = gap.noise_after = &noise;
  const Filled made = fill(*find_gap_method("kriging"), gap, TransitionModel{}, scratch);
  for (std::size_t joint = 0; joint < testing_gap::kJoints; ++joint) {
    // The rotation of a joint in a frame, plus the fading of the offset in one.
    EXPECT_LT(made.at(0, joint).angularDistance(gap.left().rotations[joint]), 0.06f) << joint;
    EXPECT_LT(made.at(59, joint).angularDistance(gap.right().rotations[joint]), 0.06f) << joint;
  }
}

}  // namespace
}  // namespace signweave
