#include "signweave/formats/bvh/euler.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace signweave::bvh {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// All orders of one, two and three different axes.
std::vector<RotationOrder> all_orders() {
  std::vector<RotationOrder> orders;
  for (int a = 0; a < 3; ++a) {
    orders.push_back({{a, 0, 0}, 1});
    for (int b = 0; b < 3; ++b) {
      if (a == b) continue;
      orders.push_back({{a, b, 0}, 2});
      orders.push_back({{a, b, 3 - a - b}, 3});
    }
  }
  return orders;
}

/// The product computed with Eigen's own functions.
Eigen::Quaterniond product(const RotationOrder& order, const Angles& angles) {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  for (int i = 0; i < order.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    rotation = rotation * Eigen::AngleAxisd(angles[at], Eigen::Vector3d::Unit(order.axes[at]));
  }
  return rotation;
}

double between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::Quaterniond turn = a.conjugate() * b;
  return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w())) / kDegree;
}

Angles some_angles(double most) {
  Angles angles{};
  for (double& angle : angles) angle = *rc::gen::inRange(-1000, 1001) * 0.001 * most * kDegree;
  return angles;
}

Angles only(Angles angles, int count) {
  for (int i = count; i < 3; ++i) angles[static_cast<std::size_t>(i)] = 0;
  return angles;
}

RC_GTEST_PROP(BvhEuler, AnglesOfARotationMakeItAgain, ()) {
  const Angles angles = some_angles(400);
  const Angles before = some_angles(800);
  for (const RotationOrder& order : all_orders()) {
    const Eigen::Quaterniond rotation = product(order, angles);
    RC_ASSERT(between(product(order, angles_of(rotation, order, nullptr)), rotation) < 1e-9);
    RC_ASSERT(between(product(order, angles_of(rotation, order, &before)), rotation) < 1e-9);
    const Eigen::Quaterniond negated(-rotation.coeffs());
    RC_ASSERT(between(product(order, angles_of(negated, order, &before)), rotation) < 1e-9);
  }
}

RC_GTEST_PROP(BvhEuler, AtAndNearGimbalLockAFloatQuaternionComesBackWithinATenthOfAMillidegree, ()) {
  Angles angles = some_angles(400);
  const double side = *rc::gen::element(-90.0, 90.0, 270.0);
  const double off = *rc::gen::element(0.0, 1e-6, 1e-5, 1e-4, 1e-3, -1e-5, 0.01);
  angles[1] = (side + off) * kDegree;
  const Angles before = some_angles(400);
  for (const RotationOrder& order : all_orders()) {
    const Eigen::Quaterniond exact = product(order, only(angles, order.count));
    const Eigen::Quaterniond stored = exact.cast<float>().cast<double>().normalized();
    RC_ASSERT(between(product(order, angles_of(stored, order, nullptr)), exact) < 1e-4);
    RC_ASSERT(between(product(order, angles_of(stored, order, &before)), exact) < 1e-4);
  }
}

RC_GTEST_PROP(BvhEuler, SmallStepsAreFollowedThroughWholeTurns, ()) {
  // A random walk of a few degrees per frame, away from gimbal lock or across ±90° of the middle angle: it must never
  // jump.
  Angles angles = some_angles(80);
  std::array<double, 3> speed{};
  for (double& one : speed) one = *rc::gen::inRange(-4000, 4001) * 0.001 * kDegree;
  speed[1] = 0;
  angles[1] = *rc::gen::inRange(95, 260) * kDegree;
  if (std::abs(std::cos(angles[1])) < 0.05) angles[1] += 0.1;
  for (const RotationOrder& order : all_orders()) {
    Angles truth = only(angles, order.count);
    Angles before = truth;
    for (int frame = 0; frame < 300; ++frame) {
      before = angles_of(product(order, truth), order, &before);
      for (std::size_t i = 0; i < 3; ++i) RC_ASSERT(std::abs(before[i] - truth[i]) < 1e-6);
      for (std::size_t i = 0; i < static_cast<std::size_t>(order.count); ++i) truth[i] += speed[i];
    }
  }
}

TEST(BvhEuler, AtGimbalLockTheFreeAngleDoesNotChange) {
  for (const RotationOrder& order : all_orders()) {
    if (order.count != 3) continue;
    for (const double middle : {90.0, -90.0}) {
      const Angles before = {20 * kDegree, middle * kDegree, 200 * kDegree};
      EXPECT_EQ(between(product(order, before), product(order, before)), 0);
      const Eigen::Quaterniond same = product(order, before).cast<float>().cast<double>().normalized();
      const Angles after = angles_of(same, order, &before);
      for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(after[i], before[i], 1e-3 * kDegree) << i;
    }
  }
}

TEST(BvhEuler, TheFirstFrameIsInTheUsualRange) {
  for (const RotationOrder& order : all_orders()) {
    const Angles angles = angles_of(product(order, {3.0, 2.0, -3.5}), order, nullptr);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(std::abs(angles[i]), std::numbers::pi + 1e-12);
    const bool full = order.count == 3;
    EXPECT_LE(std::abs(angles[1]), (full ? 0.5 : 1.0) * std::numbers::pi + 1e-12);
  }
}

RC_GTEST_PROP(BvhEuler, TooFewAxesGiveTheNearestRotation, ()) {
  const RotationOrder full{{0, 1, 2}, 3};
  const Eigen::Quaterniond wanted = product(full, some_angles(180));
  for (const RotationOrder& order : all_orders()) {
    if (order.count == 3) continue;
    const Angles found = angles_of(wanted, order, nullptr);
    const double distance = between(product(order, found), wanted);
    for (int i = 0; i < 20; ++i) {
      const Angles other = some_angles(180);
      RC_ASSERT(distance <= between(product(order, other), wanted) + 1e-9);
    }
  }
}

TEST(BvhEuler, DirectionsAreThoseOfTheStandardLibrary) {
  // The angle about one axis is twice its direction, so it reveals each direction.
  const RotationOrder order{{0, 0, 0}, 1};
  double worst = 0;
  for (int i = -400'000; i <= 400'000; ++i) {
    const double half = i * 1e-5 * std::numbers::pi / 4;
    const double rise = std::sin(half);
    const double run = std::cos(half);
    const Angles before = {2 * std::atan2(rise, run), 0, 0};
    const Angles found = angles_of(Eigen::Quaterniond(run, rise, 0, 0), order, &before);
    worst = std::max(worst, std::abs(found[0] - before[0]) / 2);
  }
  EXPECT_LE(worst, 9e-16);  // an ulp of π is 4.4e-16, and the standard library has errors too
  for (const double run : {1.0, -1.0, 0.0, -0.0}) {
    for (const double rise : {1.0, -1.0, 0.0, -0.0, 1e-300}) {
      const Angles before = {2 * std::atan2(rise, run), 0, 0};
      EXPECT_NEAR(angles_of(Eigen::Quaterniond(run, rise, 0, 0), order, &before)[0], before[0], 1e-15);
    }
  }
}

RC_GTEST_PROP(BvhEuler, AWholeFrameAtATimeGivesWhatOneJointAtATimeDoes, ()) {
  const std::vector<RotationOrder> orders = [] {
    std::vector<RotationOrder> all = all_orders();
    all.push_back({{}, 0});
    return all;
  }();
  AngleFinder finder(orders);
  std::vector<Angles> before(orders.size());
  for (int frame = 0; frame < 20; ++frame) {
    std::vector<Eigen::Quaterniond> rotations;
    Angles angles = some_angles(180);
    if (frame % 3 == 0) angles[1] = 90 * kDegree;
    for (const RotationOrder& order : orders) rotations.push_back(product(order, only(angles, order.count)));
    const std::span<const Angles> found = finder.next(rotations);
    RC_ASSERT(found.size() == orders.size());
    for (std::size_t i = 0; i < orders.size(); ++i) {
      before[i] = angles_of(rotations[i], orders[i], frame == 0 ? nullptr : &before[i]);
      RC_ASSERT(found[i] == before[i]);
    }
  }
}

}  // namespace
}  // namespace signweave::bvh
