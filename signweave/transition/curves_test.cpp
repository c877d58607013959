#include "signweave/transition/curves.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>

#include "signweave/transition/curve_loops.h"
#include "signweave/transition/kriging.h"
#include "signweave/transition/test_gap_motion.h"

namespace signweave {
namespace {

using namespace testing_gap;

TEST(Curves, RotationVectorsRoundTrip) {
  for (const double angle : {0.0, 1e-9, 1e-4, 1.0, std::numbers::pi - 1e-4, std::numbers::pi, 5.0, 6.2}) {
    const Eigen::Quaternionf q = about({1, 2, -1}, angle);  // with this sign: beyond half a turn w is negative
    EXPECT_NEAR(rotation_vector(q).norm(), angle, 2e-5) << angle;
    EXPECT_LT((rotation_of(rotation_vector(q)).coeffs() - q.coeffs()).norm(), 2e-6f) << angle;
  }
}

TEST(Curves, DerivativesOfAQuadraticAreExact) {
  for (const double hertz : {5.0, 30.0, 120.0, 2000.0}) {
    std::vector<Eigen::Vector3f> path;
    for (int k = 0; k < 200; ++k) {
      const auto t = static_cast<float>(k / hertz);
      path.emplace_back(1 + 2 * t - 3 * t * t, 0, 0.5f * t * t);
    }
    const BorderMotion after = motion_after(path, hertz);
    EXPECT_LT((after.velocity - Eigen::Vector3f(2, 0, 0)).norm(), 2e-3f) << hertz;
    EXPECT_LT((after.acceleration - Eigen::Vector3f(-6, 0, 1)).norm(), 0.1f) << hertz;
    const BorderMotion before = motion_before(path, hertz);  // the same path, reversed
    EXPECT_LT((before.velocity - Eigen::Vector3f(-2, 0, 0)).norm(), 2e-3f) << hertz;
    EXPECT_LT((before.acceleration - Eigen::Vector3f(-6, 0, 1)).norm(), 0.1f) << hertz;
  }
}

TEST(Curves, FewFramesGiveLowerOrderDerivatives) {
  const std::vector<Eigen::Vector3f> path = {{0, 0, 0}, {0.1f, 0, 0}};
  EXPECT_EQ(motion_after(std::span(path).first(1), 100).velocity, Eigen::Vector3f::Zero());
  EXPECT_NEAR(motion_after(path, 100).velocity.x(), 10, 1e-5f);
  EXPECT_NEAR(motion_before(path, 100).velocity.x(), -10, 1e-5f);
  EXPECT_EQ(motion_after(path, 100).acceleration, Eigen::Vector3f::Zero());
}

Gap gap_of(std::int64_t count, double hertz) {
  Gap gap;
  gap.rate = {static_cast<std::uint32_t>(hertz), 1};
  gap.count = count;
  return gap;
}

TEST(GapTime, ShortGapsAreNotSlowed) {
  const Gap gap = gap_of(149, 100);
  const GapTime time(gap);
  EXPECT_EQ(time.seconds(), gap.duration().count());
  for (std::int64_t frame = 0; frame < 149; ++frame) EXPECT_EQ(time.at(frame), static_cast<double>(frame + 1) / 150);
}

TEST(GapTime, IsMonotonicAndHasUnitSpeedAtTheBorders) {
  for (const std::int64_t count : {150, 151, 299, 3000, 100'000}) {
    const Gap gap = gap_of(count, 100);
    const GapTime time(gap);
    EXPECT_EQ(time.seconds(), kLongestCurve);
    double last = 0;
    double speed = 1;
    for (std::int64_t frame = 0; frame <= count; ++frame) {
      const double at = frame < count ? time.at(frame) : 1.0;
      const double step = (at - last) * kLongestCurve * 100;  // curve time per frame time
      ASSERT_GT(step, 0);
      ASSERT_LE(step, 1 + 1e-6);
      ASSERT_NEAR(step, speed, 0.021) << count << ' ' << frame;
      if (frame < count) {
        ASSERT_NEAR(at, 1 - time.at(count - 1 - frame), 1e-12);
      }
      speed = step;
      last = at;
    }
    EXPECT_NEAR(time.at(0) * kLongestCurve, 0.01, 1e-5);
    EXPECT_NEAR(speed, 1, 1e-3);
    EXPECT_EQ(GapTime::even(gap).at(1), 2.0 / static_cast<double>(count + 1));
  }
}

/// A gap's kriging weights at a time.
std::vector<float> weights(const Kriging& kriging, double t) {
  std::vector<float> row(kriging.terms());
  kriging.row(t, 0, row.data());
  return row;
}

TEST(Kriging, WeightsSumToOneAndSelectTheBordersAtTheBorders) {
  const JointGroups of = groups();
  std::vector<double> memory;
  for (const FrameRate rate : {FrameRate{1, 1}, FrameRate{24, 1}, FrameRate{120, 1}, FrameRate{2000, 1}}) {
    const Motion motion = lively(1, rate, 900);
    for (const std::int64_t count : {1, 5, 60, 500}) {
      for (const std::int64_t context : {1, 2, 1000}) {
        const Gap gap = cut(motion, of, {200, 200 + count}, context);
        const Kriging kriging(gap, GapTime(gap), memory, Kriging::Weights::solved);
        ASSERT_LE(kriging.terms(), 20u);
        std::size_t left = 0;  // number of samples of the left side, its border first
        for (const double t : {0.0, 0.1, 0.5, 0.77, 1.0}) {
          const std::vector<float> row = weights(kriging, t);
          float sum = 0;
          for (const float weight : row) sum += weight;
          EXPECT_NEAR(sum, 1, 1e-3) << rate.hertz() << ' ' << count << ' ' << t;
          if (count == 1) continue;  // a millisecond apart, both borders have the same weight
          if (t == 0.0) {
            EXPECT_NEAR(row[0], 1, 2e-2) << rate.hertz() << ' ' << count;
          }
          if (t == 1.0) {
            while (left < row.size() && std::abs(row[left] - 1) > 2e-2f) ++left;
            EXPECT_LT(left, row.size()) << rate.hertz() << ' ' << count;
          }
        }
      }
    }
  }
}

TEST(Kriging, CachedWeightsEqualSolvedOnes) {
  const JointGroups of = groups();
  std::vector<double> memory;
  for (const FrameRate rate : {FrameRate{30, 1}, FrameRate{97, 1}}) {
    const Motion motion = lively(1, rate, 900);
    for (const std::int64_t count : {1, 7, 128, 129, 400}) {
      Gap gap = cut(motion, of, {200, 200 + count});
      for (const double pause : {0.0, 0.4}) {
        gap.pause = Seconds(pause);
        const GapTime time(gap);
        const Kriging solved(gap, time, memory, Kriging::Weights::solved);
        std::vector<float> expected;
        for (std::int64_t frame = 0; frame < count; ++frame) {
          expected.resize(expected.size() + solved.terms());
          solved.row(time.at(frame), frame, &expected[expected.size() - solved.terms()]);
        }
        for (int time_asked = 0; time_asked < 2; ++time_asked) {  // written, then read
          std::vector<double> own;
          const Kriging kept(gap, time, own);
          std::vector<float> row(kept.terms());
          for (std::int64_t frame = 0; frame < count; ++frame) {
            kept.row(time.at(frame), frame, row.data());
            ASSERT_TRUE(std::equal(row.begin(), row.end(), expected.begin() + frame * std::ssize(row)))
                << count << ' ' << frame << ' ' << pause;
          }
        }
      }
    }
  }
}

TEST(Curves, SamplingAllJointsEqualsSamplingEach) {
  const JointGroups of = groups();
  const Motion motion = lively(3.7, {100, 1}, 400);
  for (const std::int64_t count : {5, 60, 200}) {
    const Gap gap = cut(motion, of, {100, 100 + count});
    GapScratch scratch;
    GapScratch alone;
    const GapJob job{.gap = gap, .model = default_transition_model(), .scratch = scratch};
    see_all(job);
    for (std::size_t i = 0; i < scratch.joints; ++i) {
      const Sides sides = sides_of(job, i, 1);
      see_joint(gap, sides.joint, alone);
      ASSERT_EQ(sides.before.size(), alone.before.size());
      for (std::size_t k = 0; k < alone.before.size(); ++k) {
        EXPECT_LT((sides.before[k] - alone.before[k]).norm(), 2e-6f) << count << ' ' << sides.joint << ' ' << k;
        EXPECT_LT((sides.after[k] - alone.after[k]).norm(), 2e-6f) << count << ' ' << sides.joint << ' ' << k;
      }
    }
  }
}

TEST(Curves, VectorsOfAllJointsEqualThoseOfEach) {
  const JointGroups of = groups();
  for (const std::uint32_t hertz : {24u, 100u, 500u}) {
    const Motion motion = lively(1.9, {hertz, 1}, 4 * hertz);
    const Gap gap = cut(motion, of, {hertz, 2 * hertz});
    const GapTime time(gap);
    GapScratch scratch;
    const GapJob job{.gap = gap, .model = default_transition_model(), .scratch = scratch};
    see_all(job);
    std::vector<double> memory;
    const auto compare = [&](const auto& family) {
      const std::size_t width = 3 * scratch.taken.size();
      std::vector<float> vectors(family.terms() * width);
      family.vectors(scratch, time.seconds(), vectors.data());
      std::vector<Eigen::Vector3f> own(family.terms());
      for (std::size_t i = 0; i < scratch.taken.size(); ++i) {
        family.coefficients(sides_of(job, i, time.seconds()), own.data());
        for (std::size_t k = 0; k < own.size() * 3; ++k) {
          const float vector = vectors[k / 3 * width + k % 3 * scratch.taken.size() + i];
          EXPECT_NEAR(vector, own[k / 3][static_cast<Eigen::Index>(k % 3)], 1e-5f) << hertz << ' ' << i << ' ' << k;
        }
      }
    };
    compare(Kriging(gap, time, memory));
    compare(FingerCurves(gap));
  }
}

TEST(Curves, VectorsOfAnyLengthGiveTheirRotations) {
  std::vector<float> vectors;  // [x y z][joint]
  constexpr std::size_t kCount = 5 * curve_loops::kLanes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < kCount; ++i) {
      vectors.push_back(0.17f * static_cast<float>(i) * std::array{0.6f, -0.64f, 0.48f}[axis]);
    }
  }
  std::vector<float> middles(4 * kCount);
  const Eigen::Quaternionf middle(Eigen::AngleAxisf(0.8f, Eigen::Vector3f(1, 2, -1).normalized()));
  for (std::size_t axis = 0; axis < 4; ++axis) {
    std::fill_n(middles.begin() + static_cast<std::ptrdiff_t>(axis * kCount), kCount,
                middle.coeffs()[static_cast<Eigen::Index>(axis)]);
  }
  std::vector<float> turned(4 * kCount);
  const JointReaches free{std::vector<float>(kCount), std::vector<float>(kCount)};
  curve_loops::make_turns(
      std::array{1.0f},
      {.vectors = vectors.data(), .reaches = free, .middles = middles.data(), .count = kCount, .width = kCount},
      turned.data());
  for (std::size_t i = 0; i < kCount; ++i) {
    const Eigen::Quaternionf expected =
        middle * rotation_of({vectors[i], vectors[kCount + i], vectors[2 * kCount + i]});
    for (std::size_t axis = 0; axis < 4; ++axis) {
      EXPECT_NEAR(turned[axis * kCount + i], expected.coeffs()[static_cast<Eigen::Index>(axis)], 1e-6) << i;
    }
  }
}

TEST(Kriging, MatchesTheBorders) {
  const JointGroups of = groups();
  std::vector<double> memory;
  for (const FrameRate rate : {FrameRate{1, 1}, FrameRate{24, 1}, FrameRate{120, 1}, FrameRate{2000, 1}}) {
    const Motion motion = lively(1, rate, 900);
    const Gap gap = cut(motion, of, {200, 240});
    Kriging kriging(gap, GapTime(gap), memory, Kriging::Weights::solved);
    GapScratch scratch;
    see_joint(gap, kUpper, scratch);
    Sides sides;
    sides.before = scratch.before;
    sides.after = scratch.after;
    sides.hertz = rate.hertz();
    sides.seconds = gap.duration().count();
    std::vector<Eigen::Vector3f> vectors(kriging.terms());
    kriging.coefficients(sides, vectors.data());
    for (const double t : {0.0, 1.0}) {
      const std::vector<float> row = weights(kriging, t);
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (std::size_t i = 0; i < row.size(); ++i) sum += row[i] * vectors[i];
      EXPECT_LT((sum - (t == 0.0 ? sides.left() : sides.right())).norm(), 2e-3f) << rate.hertz() << ' ' << t;
    }
  }
}

TEST(Kriging, IsIndependentOfTheFrameRate) {
  // Capturing at twice the rate gives the same movement.
  const JointGroups of = groups();
  const auto middle = [&](std::uint32_t hertz) {
    const Motion motion = lively(2, {hertz, 1}, 3 * hertz);
    const Filled made = fill(*find_gap_method("kriging"), cut(motion, of, {hertz, hertz + hertz / 2 - 1}), untaught());
    return made.at(hertz / 4 - 1, kUpper);
  };
  for (const std::uint32_t hertz : {60u, 240u, 2000u}) EXPECT_LT(angle(middle(hertz), middle(120)), 0.04) << hertz;
}

TEST(Learned, BendsVanishAtTheBorders) {
  for (const double t : {0.0, 1.0}) {
    for (const double bend : bends_at(t)) EXPECT_EQ(bend, 0);
  }
  EXPECT_EQ(bends_at(0.5)[0], 1);
}

TEST(Learned, InterpolatesLogarithmicallyAndClampsOutsideTheKnots) {
  EXPECT_EQ(between_knots(0.01).part, 0);
  EXPECT_EQ(between_knots(0.01).lower, 0u);
  EXPECT_EQ(between_knots(60).lower, kKnots.size() - 2);
  EXPECT_EQ(between_knots(60).part, 1);
  const BetweenKnots at = between_knots(std::sqrt(0.28 * 0.52));
  EXPECT_EQ(at.lower, 1u);
  EXPECT_NEAR(at.part, 0.5, 1e-9);
  EXPECT_EQ(between_knots(std::nan("")).part, 0);
}

TEST(BorderVelocity, IsThatOfTheQuadratic) {
  std::vector<Eigen::Vector3f> path;
  for (int i = 0; i < 12; ++i) {
    const auto t = static_cast<float>(i);
    path.emplace_back(std::sin(0.3f * t), 0.02f * t * t, 1 - 0.1f * t);
  }
  for (const double hertz : {24.0, 30.0, 100.0, 120.0}) {
    for (const std::size_t samples : {1u, 2u, 3u, 4u, 12u}) {
      const auto seen = std::span(path).first(samples);
      const BorderVelocity velocity(samples, hertz);
      EXPECT_LT((velocity.of(seen) - motion_after(seen, hertz).velocity).norm(), 1e-4f) << hertz << ' ' << samples;
      EXPECT_LT((velocity.of(seen) + motion_before(seen, hertz).velocity).norm(), 1e-4f) << hertz << ' ' << samples;
    }
  }
  const std::vector<Eigen::Vector3f> many(2000, Eigen::Vector3f::Ones());
  EXPECT_EQ(BorderVelocity(many.size(), 10000).of(many).norm(), 0) << "no more samples are used than it stores";
}

}  // namespace
}  // namespace signweave
