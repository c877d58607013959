#include "signweave/features/smoothing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace signweave {
namespace {

using Eigen::Vector3f;

std::vector<Vector3f> parabola(std::int64_t frames, double hertz) {
  std::vector<Vector3f> path;
  for (std::int64_t i = 0; i < frames; ++i) {
    const auto t = static_cast<float>(static_cast<double>(i) / hertz);
    path.emplace_back(1 + 2 * t - 3 * t * t, 0.5f * t * t, 4);
  }
  return path;
}

TEST(Smoother, ReproducesAParabolaAtEveryFrameAndRate) {
  for (const FrameRate rate : {FrameRate{24, 1}, FrameRate{60, 1}, FrameRate{120, 1}, FrameRate{30000, 1001}}) {
    const std::vector<Vector3f> path = parabola(40, rate.hertz());
    const Smoother smoother(Seconds(0.1), rate, 40);
    for (std::int64_t frame = 0; frame < 40; ++frame) {
      const auto t = static_cast<float>(static_cast<double>(frame) / rate.hertz());
      const PathDerivatives at = smoother.at(frame, path, 0);
      EXPECT_LT((at.velocity - Vector3f(2 - 6 * t, t, 0)).norm(), 2e-3f) << frame;
      EXPECT_LT((at.acceleration - Vector3f(-6, 1, 0)).norm(), 0.1f) << frame;
    }
  }
}

TEST(Smoother, UsesATenthOfASecondAndAtLeastThreeFrames) {
  const auto window = [](FrameRate rate, std::int64_t frame) {
    return Smoother(Seconds(0.1), rate, 1000).window(frame);
  };
  EXPECT_EQ(window({100, 1}, 500), (FrameRange{495, 506}));
  EXPECT_EQ(window({120, 1}, 500), (FrameRange{494, 507}));
  EXPECT_EQ(window({60, 1}, 500), (FrameRange{497, 504}));
  EXPECT_EQ(window({30, 1}, 500), (FrameRange{499, 502}));
  EXPECT_EQ(window({10, 1}, 500), (FrameRange{499, 502}));
  EXPECT_EQ(window({1'000'000, 1}, 500).size(), Smoother::kMostWindow);
  EXPECT_EQ(window({60, 1}, 0), (FrameRange{0, 7}));  // one-sided at the ends
  EXPECT_EQ(window({60, 1}, 2), (FrameRange{0, 7}));
  EXPECT_EQ(window({60, 1}, 999), (FrameRange{993, 1000}));
  EXPECT_EQ(Smoother(Seconds(0.1), {60, 1}, 1000).window(FrameRange{0, 10}), (FrameRange{0, 13}));
}

TEST(Smoother, SmoothsNoise) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, 0.001f);  // a millimetre
  std::vector<Vector3f> path;
  for (int i = 0; i < 2000; ++i) path.emplace_back(noise(random), 0, 0);
  const Smoother smoother(Seconds(0.1), {120, 1}, 2000);
  double ours = 0;
  double differences = 0;
  for (std::int64_t i = 1; i + 1 < 2000; ++i) {
    ours += std::pow(smoother.at(i, path, 0).velocity.norm(), 2);
    differences +=
        std::pow(60 * (path[static_cast<std::size_t>(i) + 1] - path[static_cast<std::size_t>(i) - 1]).norm(), 2);
  }
  EXPECT_LT(std::sqrt(ours / differences), 0.2);
}

TEST(Smoother, AcceptsTwoFramesAndOne) {
  const std::vector<Vector3f> path = {{0, 0, 0}, {0.1f, 0, 0}};
  const Smoother two(Seconds(0.1), {10, 1}, 2);
  for (const std::int64_t frame : {0, 1}) {
    EXPECT_LT((two.at(frame, path, 0).velocity - Vector3f(1, 0, 0)).norm(), 1e-6f);
    EXPECT_EQ(two.at(frame, path, 0).acceleration, Vector3f::Zero().eval());
  }
  const Smoother one(Seconds(0.1), {10, 1}, 1);
  EXPECT_EQ(one.at(0, {path.data(), 1}, 0).velocity, Vector3f::Zero().eval());
  EXPECT_EQ(one.at(0, {path.data(), 1}, 0).acceleration, Vector3f::Zero().eval());
}

}  // namespace
}  // namespace signweave
