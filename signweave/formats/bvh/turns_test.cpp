#include "signweave/formats/bvh/turns.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace signweave::bvh {
namespace {

struct Halves {
  std::vector<double> sines, cosines;
};

Halves halves_of(const std::vector<double>& degrees) {
  Halves halves{std::vector<double>(degrees.size()), std::vector<double>(degrees.size())};
  half_angles(degrees, halves.sines, halves.cosines);
  return halves;
}

/// The largest deviation from the standard library's result in higher precision.
double worst_of(const std::vector<double>& degrees) {
  const Halves halves = halves_of(degrees);
  double worst = 0;
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    // Full double turns are subtracted exactly first: π as a long double is not accurate enough for many of them.
    const long double half =
        std::fmod(static_cast<long double>(degrees[i]), 720.0L) * std::numbers::pi_v<long double> / 360;
    worst = std::max(worst, static_cast<double>(std::abs(std::sin(half) - halves.sines[i])));
    worst = std::max(worst, static_cast<double>(std::abs(std::cos(half) - halves.cosines[i])));
  }
  return worst;
}

TEST(BvhTurns, HalfAnglesLieWithinTheirBoundOverTheWholeRange) {
  std::vector<double> degrees;
  for (int i = -800'000; i <= 800'000; ++i) degrees.push_back(i * 0.0009);
  EXPECT_LE(worst_of(degrees), 1e-15);
  std::mt19937_64 random(1);
  for (const double most : {1e-6, 1.0, 1e4, 1e9}) {
    std::uniform_real_distribution<double> any(-most, most);
    for (double& one : degrees) one = any(random);
    EXPECT_LE(worst_of(degrees), 1e-15) << most;
  }
}

TEST(BvhTurns, ZeroAnglesAreExact) {
  const Halves halves = halves_of({0.0, -0.0, 720.0, 360.0});
  EXPECT_EQ(halves.sines, (std::vector<double>{0, 0, 0, 0}));
  EXPECT_EQ(halves.cosines, (std::vector<double>{1, 1, 1, -1}));
}

/// Every order of up to three rotation channels, with positions between them.
std::vector<std::vector<Channel>> all_joints() {
  std::vector<std::vector<Channel>> joints = {{}, {Channel::y_position}};
  const auto rotation = [](int axis) { return static_cast<Channel>(3 + axis); };
  for (int a = 0; a < 3; ++a) {
    joints.push_back({rotation(a)});
    for (int b = 0; b < 3; ++b) {
      if (a == b) continue;
      joints.push_back({rotation(a), Channel::x_position, rotation(b)});
      joints.push_back({Channel::z_position, rotation(a), rotation(b), rotation(3 - a - b)});
    }
  }
  return joints;
}

RC_GTEST_PROP(BvhTurns, RotationsAreTheProductOfTheirChannelsInOrder, ()) {
  const std::vector<std::vector<Channel>> joints = all_joints();
  std::vector<double> numbers;
  for (const auto& channels : joints) {
    for (std::size_t i = 0; i < channels.size(); ++i)
      numbers.push_back(*rc::gen::inRange(-4'000'000, 4'000'001) * 1e-4);
  }
  Turns turns(joints);
  std::vector<Eigen::Quaternionf> rotations(joints.size());
  turns.apply(numbers, rotations);
  std::size_t at = 0;
  for (std::size_t joint = 0; joint < joints.size(); ++joint) {
    Eigen::Quaterniond expected = Eigen::Quaterniond::Identity();
    for (const Channel channel : joints[joint]) {
      const double value = numbers[at++];
      if (channel < Channel::x_rotation) continue;
      expected = expected * Eigen::AngleAxisd(value * std::numbers::pi / 180,
                                              Eigen::Vector3d::Unit(static_cast<int>(channel) - 3));
    }
    // Half a unit in the last place of a float, and hardly more, because the product itself is exact.
    RC_ASSERT((rotations[joint].coeffs().cast<double>() - expected.coeffs()).cwiseAbs().maxCoeff() < 3.0e-8);
  }
}

}  // namespace
}  // namespace signweave::bvh
