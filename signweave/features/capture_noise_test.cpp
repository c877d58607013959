#include "signweave/features/capture_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace signweave {
namespace {

std::shared_ptr<const Skeleton> three_joints() {
  return std::make_shared<const Skeleton>(
      std::vector<Joint>{
          {"Hips", kNoJoint, {0, 1, 0}, true}, {"Arm", 0, {0.3f, 0, 0}, false}, {"Fore", 1, {0.3f, 0, 0}, false}},
      std::vector<Tip>{});
}

/// Movements of 0.8 s, with or without rests between them, with the given noise.
Motion captured(FrameRate rate, float radians, float metres, bool rests, std::uint32_t seed = 1) {
  const auto frames = static_cast<std::int64_t>(20 * rate.hertz());
  Motion motion(three_joints(), rate, frames);
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  const auto shaken = [&](float by) {
    return Eigen::Vector3f(by * normal(random), by * normal(random), by * normal(random));
  };
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const double seconds = static_cast<double>(frame) / rate.hertz();
    const double within = std::fmod(seconds, rests ? 1.6 : 0.8);
    const double x = std::min(1.0, within / 0.8);
    const double angle = 0.6 * (rests && x >= 1 ? 1.0 : std::sin(M_PI * (rests ? x - 0.5 : 2 * x)));
    for (std::size_t joint = 0; joint < 3; ++joint) {
      Eigen::Quaternionf noise(1, 0, 0, 0);
      noise.vec() = 0.5f * shaken(radians);
      motion.pose(frame).rotations[joint] =
          Eigen::AngleAxisf(static_cast<float>(angle), Eigen::Vector3f(0.3f, 1, 0.2f).normalized()) *
          noise.normalized();
    }
    motion.pose(frame).translations[0] = Eigen::Vector3f(0.1f * static_cast<float>(angle), 1, 0) + shaken(metres);
  }
  return motion;
}

constexpr FrameRate kRates[] = {{24, 1}, {30, 1}, {60, 1}, {100, 1}, {120, 1}};

TEST(CaptureNoise, IsMeasuredInStillFramesAtEveryRate) {
  for (const FrameRate rate : kRates) {
    for (const float radians : {0.002f, 0.01f}) {
      SCOPED_TRACE(testing::Message() << rate.hertz() << " frames a second, " << radians);
      const CaptureNoise noise = capture_noise(captured(rate, radians, 0.003f, true));
      for (const float one : noise.rotations) EXPECT_NEAR(one, radians, 0.25f * radians);
      EXPECT_NEAR(noise.translations.at(0), 0.003f, 0.25f * 0.003f);
    }
  }
}

TEST(CaptureNoise, OfACleanCaptureIsZero) {
  for (const FrameRate rate : kRates) {
    for (const bool rests : {true, false}) {
      SCOPED_TRACE(testing::Message() << rate.hertz() << " frames a second" << (rests ? ", with rests" : ""));
      const CaptureNoise noise = capture_noise(captured(rate, 0, 0, rests));
      for (const float one : noise.rotations) EXPECT_LT(one, 1e-5f);
      EXPECT_LT(noise.translations.at(0), 1e-5f);
    }
  }
}

TEST(CaptureNoise, IsMeasuredWithoutRestsIfItExceedsNonQuadraticMovement) {
  const CaptureNoise noise = capture_noise(captured({60, 1}, 0.01f, 0, false));
  for (const float one : noise.rotations) EXPECT_NEAR(one, 0.01f, 0.003f);
}

TEST(CaptureNoise, OfTooFewFramesOrNonFiniteValuesIsZero) {
  Motion short_one(three_joints(), {60, 1}, 10);
  for (const float one : capture_noise(short_one).rotations) EXPECT_EQ(one, 0);
  EXPECT_EQ(capture_noise(Motion(three_joints(), {60, 1}, 0)).rotations.size(), 3u);
  Motion none = captured({60, 1}, 0.01f, 0.003f, true);
  for (std::int64_t frame = 0; frame < none.frame_count(); ++frame) {
    none.pose(frame).rotations[1].coeffs().setConstant(std::nanf(""));
  }
  const CaptureNoise noise = capture_noise(none);
  EXPECT_EQ(noise.rotations[1], 0);
  EXPECT_NEAR(noise.rotations[2], 0.01f, 0.0025f);
}

}  // namespace
}  // namespace signweave
