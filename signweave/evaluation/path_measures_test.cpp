#include "signweave/evaluation/path_measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "signweave/evaluation/wrist_kinematics.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// From rest to rest over `size` metres in `seconds` with the least jerk (Flash and Hogan 1985).
std::vector<Vector3f> minimum_jerk(double size, double seconds, FrameRate rate) {
  const auto last = std::llround(seconds * rate.hertz());
  std::vector<Vector3f> path;
  for (std::int64_t i = 0; i <= last; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(last);
    const double x = size * t * t * t * (10 - 15 * t + 6 * t * t);
    path.emplace_back(static_cast<float>(0.6 * x), static_cast<float>(0.8 * x), 1.0f);
  }
  return path;
}

/// A path whose speed is exp(-5 t²), t from -1 to 1 s.
std::vector<Vector3f> bell(FrameRate rate) {
  std::vector<Vector3f> path;
  const double root = std::sqrt(5.0);
  for (std::int64_t i = 0; i < 2 * rate.numerator; ++i) {
    const double t = -1 + static_cast<double>(i) / rate.hertz();
    path.emplace_back(static_cast<float>(0.5 * std::sqrt(3.14159265358979) / root * std::erf(root * t)), 0.0f, 0.0f);
  }
  return path;
}

struct Fitted {
  std::vector<double> speeds;
  std::vector<double> jerks;
};
Fitted fitted(const std::vector<Vector3f>& path, FrameRate rate) {
  Fitted result;
  PathFit(rate).speeds(path, result.speeds);
  PathFit(rate).squared_jerks(path, result.jerks);
  return result;
}

TEST(PathMeasures, AMinimumJerkMovementHasItsKnownPeakSpeed) {
  for (const std::int64_t hertz : {30, 60, 120}) {
    const FrameRate rate{hertz, 1};
    const auto [speeds, jerks] = fitted(minimum_jerk(0.4, 0.8, rate), rate);
    // 15/8 of the mean speed.
    EXPECT_NEAR(*std::max_element(speeds.begin(), speeds.end()), 1.875 * 0.4 / 0.8, 0.01);
  }
}

TEST(PathMeasures, AMinimumJerkMovementHasItsKnownSmoothnessAtAnySizeAndDuration) {
  // 720 T⁻⁵ x² over (15/8 x/T)² T³. At both ends the jerk is discontinuous, which a window of 0.1 s smooths: less so
  // the longer the movement.
  const double known = -std::log(720.0 / (1.875 * 1.875));
  const FrameRate rate{120, 1};
  for (const double size : {0.1, 0.5}) {
    for (const double seconds : {2.0, 4.0}) {
      const auto [speeds, jerks] = fitted(minimum_jerk(size, seconds, rate), rate);
      EXPECT_NEAR(log_dimensionless_jerk(speeds, jerks, rate), known, 0.1) << size << " m in " << seconds << " s";
    }
  }
}

TEST(PathMeasures, TheArticlesExampleHasTheArticlesValues) {
  // Values that the programs of Balasubramanian et al. give for a speed of exp(-5 t²) at 100 Hz.
  const FrameRate rate{100, 1};
  const auto [speeds, jerks] = fitted(bell(rate), rate);
  EXPECT_NEAR(spectral_arc_length(speeds, rate), -1.41403, 0.002);
  EXPECT_NEAR(log_dimensionless_jerk(speeds, jerks, rate), -5.81636, 0.05);
}

TEST(PathMeasures, TremorIsLessSmooth) {
  const FrameRate rate{60, 1};
  std::vector<Vector3f> path = minimum_jerk(0.4, 1.0, rate);
  const auto still = fitted(path, rate);
  for (std::size_t i = 0; i < path.size(); ++i)
    path[i].z() += 0.01f * static_cast<float>(std::sin(0.5 * static_cast<double>(i)));
  const auto trembling = fitted(path, rate);
  EXPECT_LT(log_dimensionless_jerk(trembling.speeds, trembling.jerks, rate),
            log_dimensionless_jerk(still.speeds, still.jerks, rate) - 0.5);
  EXPECT_LT(spectral_arc_length(trembling.speeds, rate), spectral_arc_length(still.speeds, rate) - 0.05);
}

TEST(PathMeasures, AStillPathHasNoSmoothness) {
  const FrameRate rate{60, 1};
  const auto [speeds, jerks] = fitted(std::vector<Vector3f>(30, Vector3f(1, 2, 3)), rate);
  EXPECT_TRUE(std::isnan(log_dimensionless_jerk(speeds, jerks, rate)));
  EXPECT_TRUE(std::isnan(spectral_arc_length(speeds, rate)));
  std::vector<double> none;
  PathFit(rate).speeds(std::vector<Vector3f>(4, Vector3f::Zero()), none);
  EXPECT_TRUE(none.empty()) << "a cubic needs five points";
}

TEST(WristMeter, MeasuresLengthAndPeakOfAPath) {
  const FrameRate rate{100, 1};
  std::vector<Vector3f> path(10, Vector3f(0, 0, 1));
  for (const Vector3f& point : minimum_jerk(0.3, 0.5, rate)) path.push_back(point);
  path.resize(path.size() + 10, path.back());
  WristMeter meter(rate);
  const WristKinematics found = meter.measure(path, 10, 49);
  EXPECT_TRUE(found.moves);
  EXPECT_NEAR(found.length, 0.3, 1e-4);
  EXPECT_NEAR(found.chord, 0.3, 1e-4);
  EXPECT_NEAR(found.peak_time, 0.5, 0.021);
  // 30 t² − 60 t³ + 30 t⁴ = 0.1 · 15/8.
  EXPECT_NEAR(found.onset, 0.088, 0.03);
}

TEST(WristMeter, AKinkAtTheSeamIsAVelocityJump) {
  const FrameRate rate{100, 1};
  std::vector<Vector3f> path;
  for (int i = 0; i < 40; ++i) path.emplace_back(0.01f * static_cast<float>(i), 0.0f, 0.0f);
  WristMeter meter(rate);
  EXPECT_NEAR(meter.measure(path, 10, 18).velocity_jump, 0, 1e-6);
  for (std::size_t i = 11; i <= 28; ++i) path[i].y() = 0.02f;
  const WristKinematics found = meter.measure(path, 10, 18);
  EXPECT_NEAR(found.velocity_jump, 0.02 + 0.02, 1e-5) << "up at one seam, down at the other";
  EXPECT_NEAR(found.acceleration_jump, 2 * 0.04, 1e-5);
}

}  // namespace
}  // namespace signweave
