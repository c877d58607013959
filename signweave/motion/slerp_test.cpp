// The vectorised slerp against slerp in double precision.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "signweave/motion/blend.h"

namespace signweave {
namespace {

using Eigen::Quaterniond;
using Eigen::Quaternionf;

struct Pairs {
  std::vector<Quaternionf> a, b;
};

/// Pairs from identical to half a turn apart, in both hemispheres.
Pairs many_pairs(std::size_t count) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  Pairs pairs;
  for (std::size_t i = 0; i < count; ++i) {
    pairs.a.push_back(Quaternionf(normal(random), normal(random), normal(random), normal(random)).normalized());
    const float distance = std::pow(10.0f, 0.5f - static_cast<float>(i % 9));
    const Eigen::Vector4f away(normal(random), normal(random), normal(random), normal(random));
    Quaternionf b(Eigen::Vector4f(pairs.a.back().coeffs() + distance * away));
    b.normalize();
    if (i % 2 == 1) b.coeffs() *= -1.0f;
    pairs.b.push_back(b);
  }
  return pairs;
}

Quaterniond exact(const Quaternionf& a, const Quaternionf& b, double t, bool as_signed) {
  Quaterniond from = a.cast<double>().normalized();
  Quaterniond to = b.cast<double>().normalized();
  if (!as_signed && from.dot(to) < 0) to.coeffs() *= -1.0;
  // Computed from the chord, which is also exact for small angles.
  const double angle = 2.0 * std::atan2((from.coeffs() - to.coeffs()).norm(), (from.coeffs() + to.coeffs()).norm());
  if (angle < 1e-9) return from;
  return Quaterniond(Eigen::Vector4d((std::sin((1 - t) * angle) * from.coeffs() + std::sin(t * angle) * to.coeffs()) /
                                     std::sin(angle)));
}

double angle_to_rounded(const Quaterniond& a, const Quaternionf& b) {
  const Quaterniond other = b.cast<double>().normalized();
  return 2.0 * std::atan2((a.conjugate() * other).vec().norm(), std::abs(a.dot(other)));
}

TEST(SlerpOfMany, IsWithinAMicroradianOfTheExactArc) {
  const Pairs pairs = many_pairs(2'003);  // not a multiple of a vector's width
  std::vector<Quaternionf> out(pairs.a.size());
  for (const float t : {0.0f, 0.01f, 0.3f, 0.5f, 0.77f, 0.999f, 1.0f}) {
    slerp(pairs.a, pairs.b, t, out);
    for (std::size_t i = 0; i < out.size(); ++i) {
      ASSERT_LT(angle_to_rounded(exact(pairs.a[i], pairs.b[i], static_cast<double>(t), false), out[i]), 1e-6)
          << i << ' ' << t;
      ASSERT_NEAR(out[i].norm(), 1.0f, 3e-7f);
    }
  }
}

TEST(SlerpOfMany, TakesTheLongerArcIfTheSignsRequireIt) {
  const Pairs pairs = many_pairs(2'003);
  std::vector<Quaternionf> out(pairs.a.size());
  std::size_t longer = 0;
  for (const float t : {0.0f, 0.01f, 0.3f, 0.5f, 0.77f, 0.999f, 1.0f}) {
    slerp_as_signed(pairs.a, pairs.b, t, out);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const float dot = pairs.a[i].dot(pairs.b[i]);
      if (dot < -0.9990f) continue;  // a whole turn apart: all arcs are equally long
      if (dot < 0) ++longer;
      // Near a whole turn the direction depends on the last bits of both.
      const double tolerance = dot < 0 ? 5e-6 / std::sqrt(1.0 - static_cast<double>(dot * dot)) : 1e-6;
      ASSERT_LT(angle_to_rounded(exact(pairs.a[i], pairs.b[i], static_cast<double>(t), true), out[i]), tolerance)
          << i << ' ' << t;
    }
  }
  EXPECT_GT(longer, 100u);
}

TEST(SlerpOfMany, MayOverwriteEitherInput) {
  const Pairs pairs = many_pairs(61);
  std::vector<Quaternionf> apart(pairs.a.size());
  slerp(pairs.a, pairs.b, 0.4f, apart);
  Pairs over_a = pairs;
  slerp(over_a.a, over_a.b, 0.4f, over_a.a);
  Pairs over_b = pairs;
  slerp(over_b.a, over_b.b, 0.4f, over_b.b);
  for (std::size_t i = 0; i < apart.size(); ++i) {
    EXPECT_EQ(over_a.a[i].coeffs(), apart[i].coeffs());
    EXPECT_EQ(over_b.b[i].coeffs(), apart[i].coeffs());
  }
}

TEST(SlerpCoasting, ContinuesTurningAndBlends) {
  const Pairs pairs = many_pairs(503);
  std::mt19937 random(9);
  std::uniform_real_distribution<float> uniform(-0.1f, 0.1f);
  std::vector<Eigen::Vector3f> left(pairs.a.size()), right(pairs.a.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    left[i] = {uniform(random), uniform(random), uniform(random)};
    right[i] = {uniform(random), uniform(random), uniform(random)};
  }
  left[0].setZero();
  std::vector<Quaternionf> out(pairs.a.size());
  const float onward = 15.0f;  // up to 1.5 · √3 radians
  const float back = -7.0f;
  CoastingRotations coasting_a, coasting_b;
  coasting_a.assign(pairs.a, left);
  coasting_b.assign(pairs.b, right);
  slerp_coasting(coasting_a, onward, coasting_b, back, 0.3f, out);
  const auto turned = [](const Quaternionf& q, const Eigen::Vector3f& velocity, float frames) {
    const Eigen::Vector3d by = velocity.cast<double>() * static_cast<double>(frames);
    const double angle = by.norm();
    if (angle == 0) return q.cast<double>();
    return q.cast<double>() * Quaterniond(Eigen::AngleAxisd(angle, by / angle));
  };
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Quaterniond a = turned(pairs.a[i], left[i], onward);
    const Quaterniond b = turned(pairs.b[i], right[i], back);
    if (a.dot(b) < -0.99) continue;
    ASSERT_LT(angle_to_rounded(exact(a.cast<float>(), b.cast<float>(), 0.3, true), out[i]), 1e-5) << i;
  }
}

/// The AVX2 version of the loop gives the same bits as the other version: this sum was computed with SSE2, and the
/// sanitizer builds, which have no AVX2 version, test it, too.
TEST(SlerpCoasting, HasTheSameBitsOnEveryMachine) {
  std::uint32_t state = 1;
  const auto number = [&] {
    state = state * 1'664'525u + 1'013'904'223u;
    return static_cast<float>(static_cast<std::int32_t>(state)) * 0x1p-31f;
  };
  std::vector<Quaternionf> a, b, out(131);
  std::vector<Eigen::Vector3f> left, right;
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (std::vector<Quaternionf>* rotations : {&a, &b}) {  // in this order: arguments have none
      Quaternionf& q = rotations->emplace_back();
      for (float& value : q.coeffs()) value = number();
    }
    for (std::vector<Eigen::Vector3f>* velocities : {&left, &right}) {
      Eigen::Vector3f& velocity = velocities->emplace_back();
      for (float& value : velocity) value = 0.05f * number();
    }
  }
  CoastingRotations from, to;
  from.assign(a, left);
  to.assign(b, right);
  std::uint32_t sum = 0;
  for (const float frames : {0.0f, 3.0f, 7.5f}) {
    slerp_coasting(from, frames, to, 7.5f - frames, 0.4f, out);
    for (const Quaternionf& q : out) {
      for (const float value : q.coeffs()) sum = sum * 31 + std::bit_cast<std::uint32_t>(value);
    }
  }
  EXPECT_EQ(sum, 3'023'780'411u);
}

}  // namespace
}  // namespace signweave
