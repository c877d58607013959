#include "signweave/features/two_handed.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace signweave {
namespace {

using Eigen::Vector3f;

constexpr int kFrames = 60;
constexpr double kRate = 60;

/// Both palms over a second: position in shoulder widths, velocity in metres a second.
struct Palms {
  PointTrack left, right;
};

SignerBody body() {
  return {.shoulder_width = 0.35f, .heights = {-100, -1.3f, -0.65f, -0.2f, 0.2f, 0.4f, 0.6f, 0.9f}};
}

using Path = std::function<Vector3f(double seconds)>;  ///< shoulder widths

PointTrack along(const Path& path, float openness = 1) {
  PointTrack track;
  for (int i = 0; i < kFrames; ++i) {
    const double at = i / kRate;
    constexpr double kStep = 1e-3;
    PointFrame& frame = track.emplace_back();
    frame.position = path(at);
    frame.velocity = (path(at + kStep) - path(at - kStep)) * static_cast<float>(0.35 / (2 * kStep));
    frame.state = {.openness = openness, .palm = Facing::down, .fingers = Facing::forward};
  }
  return track;
}

/// A hand on `side` that circles in front of the body: 1 and −1 are the signer's left and right.
Path circle(float side, double phase = 0) {
  return [=](double at) {
    const double angle = 2 * std::numbers::pi * 1.5 * at + phase;
    return Vector3f(side * (0.6f + 0.2f * static_cast<float>(std::cos(angle))),
                    -0.1f + 0.3f * static_cast<float>(std::sin(angle)), 0.8f);
  };
}
Path held(const Vector3f& place) {
  return [=](double) { return place; };
}

TwoHanded measured(const Palms& palms) {
  TwoHandedSum sum;
  sum.add(palms.left, palms.right);
  return sum.movement();
}
std::optional<Hands> class_of(const Palms& palms) {
  return class_of(measured(palms), body());
}
/// The same signing by a signer with the other dominant hand.
Palms mirrored(const Palms& palms) {
  const auto flipped = [](PointTrack track) {
    for (PointFrame& frame : track) {
      frame.position.x() *= -1;
      frame.velocity.x() *= -1;
    }
    return track;
  };
  return {flipped(palms.right), flipped(palms.left)};
}
void expect_class(const Palms& palms, std::optional<Hands> expected) {
  EXPECT_EQ(class_of(palms), expected);
  EXPECT_EQ(class_of(mirrored(palms)), expected);
}

TEST(Hands, AreSymmetricIfTheyMoveAlikeAtOneTime) {
  expect_class({along(circle(1)), along(circle(-1))}, Hands::symmetric);
  // Side by side: what is mirrored is opposed.
  const auto parallel = [](float x) {
    return along([=](double at) { return Vector3f(x + 0.3f * static_cast<float>(std::sin(9 * at)), 0, 0.7f); });
  };
  const Palms palms{parallel(0.5f), parallel(-0.5f)};
  EXPECT_LT(measured(palms).mirrored, -0.9f);
  expect_class(palms, Hands::symmetric);
}

TEST(Hands, AreSymmetricInOneStraightMovement) {
  const auto out = [](float side) {
    return along([=](double at) { return Vector3f(side * static_cast<float>(0.2 + at), 0, 0.7f); });
  };
  expect_class({out(1), out(-1)}, Hands::symmetric);
}

TEST(Hands, AlternateHalfAMovementApart) {
  const Palms palms{along(circle(1)), along(circle(-1, std::numbers::pi))};
  EXPECT_LT(measured(palms).mirrored, -0.9f);
  expect_class(palms, Hands::alternating);
}

TEST(Hands, DoNotAlternateBecauseBothMoveToOneSide) {
  const auto to_left = [](float x, float up) {
    return along(
        [=](double at) { return Vector3f(x + static_cast<float>(0.5 * at), up * static_cast<float>(at), 0.7f); });
  };
  const Palms palms{to_left(0.4f, 0), to_left(-0.8f, 0.95f)};
  EXPECT_LT(measured(palms).mirrored, kOpposed);
  expect_class(palms, Hands::asymmetric);
}

TEST(Hands, AreAsymmetricAQuarterOfAMovementApart) {
  expect_class({along(circle(1)), along(circle(-1, std::numbers::pi / 2))}, Hands::asymmetric);
}

TEST(Hands, AreAsymmetricIfOneIsHeldBeneathTheOther) {
  expect_class({along(held({0.2f, -0.3f, 0.8f})), along(circle(-1))}, Hands::asymmetric);
}

TEST(Hands, AreOneIfTheOtherIsHeldFarAway) {
  const Palms far{along(held({1.2f, 0, 0.5f})), along(circle(-1))};
  expect_class(far, Hands::one);
  Palms touching = far;
  touching.left[30].state.contact = Contact::hands;
  expect_class(touching, Hands::asymmetric);
}

TEST(Hands, AreOneIfTheOtherRestsOrFallsToRest) {
  Palms resting{along(held({0.5f, -1.4f, 0.3f})), along(circle(-1))};
  expect_class(resting, Hands::one);
  resting.left[0].state.contact = Contact::hands;
  expect_class(resting, Hands::asymmetric);
  const Path falling = [](double at) { return Vector3f(0.5f, static_cast<float>(-0.1 - 0.7 * at), 0.5f); };
  const Path raised = [](double at) -> Vector3f { return circle(-1)(at) + Vector3f(0, 0.5f, 0); };
  const Palms palms{along(falling), along(raised)};
  EXPECT_GT(measured(palms).palms[0].height, -0.5f);
  EXPECT_GT(measured(palms).speed_ratio, kBaseRatio);
  expect_class(palms, Hands::one);
}

TEST(Hands, MayMoveBothBelowTheChest) {
  const auto low = [](float side) {
    return [=](double at) -> Vector3f { return circle(side)(at) - Vector3f(0, 0.9f, 0); };
  };
  expect_class({along(low(1)), along(low(-1))}, Hands::symmetric);
}

TEST(Hands, NeitherMoveAlikeNorInTurnWithDifferentHandshapes) {
  expect_class({along(circle(1), 0.2f), along(circle(-1), 0.9f)}, Hands::asymmetric);
  expect_class({along(circle(1), 0.2f), along(circle(-1, std::numbers::pi), 0.9f)}, Hands::asymmetric);
  Palms fingerless{along(circle(1), 0.2f), along(circle(-1), 0.9f)};
  for (PointFrame& frame : fingerless.left) frame.state = {};
  expect_class(fingerless, Hands::symmetric);
}

TEST(Hands, AreOfNoClassIfNeitherMoves) {
  expect_class({along(held({0.4f, 0, 0.7f})), along(held({-0.4f, 0, 0.7f}))}, std::nullopt);
}

TEST(Hands, AreOfNoClassIfAFrameIsNotFinite) {
  for (const int frame : {0, kFrames / 2, kFrames - 1}) {
    Palms palms{along(circle(1)), along(circle(-1))};
    palms.left[static_cast<std::size_t>(frame)].position.y() = std::numeric_limits<float>::quiet_NaN();
    expect_class(palms, std::nullopt);
    palms = {along(circle(1)), along(circle(-1))};
    palms.left[static_cast<std::size_t>(frame)].velocity.x() = std::numeric_limits<float>::infinity();
    expect_class(palms, std::nullopt);
  }
}

TEST(Hands, OfSpansAddUpToTheWhole) {
  Palms palms{along(circle(1), 0.3f), along(circle(-1, 1))};
  palms.left[30].state.contact = Contact::hands;
  palms.left[5].position = palms.right[5].position;
  const auto part = [](const PointTrack& track, std::size_t begin, std::size_t count) {
    return std::span(track).subspan(begin, count);
  };
  TwoHandedSum first, second;
  first.add(part(palms.left, 0, 20), part(palms.right, 0, 20));
  second.add(part(palms.left, 20, 40), part(palms.right, 20, 40));
  const TwoHanded whole = measured(palms);
  for (TwoHandedSum sum : {TwoHandedSum(first) += second, TwoHandedSum(second) += first}) {
    const TwoHanded joined = sum.movement();
    EXPECT_NEAR(joined.mirrored, whole.mirrored, 1e-6);
    EXPECT_NEAR(joined.parallel, whole.parallel, 1e-6);
    EXPECT_NEAR(joined.speed_ratio, whole.speed_ratio, 1e-6);
    EXPECT_NEAR(joined.openness_apart, whole.openness_apart, 1e-6);
    EXPECT_EQ(joined.least_distance, whole.least_distance);
    EXPECT_EQ(joined.contact, whole.contact);
    for (std::size_t side = 0; side < 2; ++side) {
      EXPECT_NEAR(joined.palms[side].height, whole.palms[side].height, 1e-6);
      EXPECT_EQ(joined.palms[side].least_height, whole.palms[side].least_height);
    }
  }
}

TEST(Hands, MoveBothIfEachIsFastEnough) {
  TwoHanded movement;
  movement.palms[0].mean_speed = 0.16f;
  movement.palms[1].mean_speed = 0.5f;
  EXPECT_TRUE(both_move(movement));
  movement.palms[0].mean_speed = 0.14f;
  EXPECT_FALSE(both_move(movement));
}

RC_GTEST_PROP(Hands, KeepTheirClassInAMirror, ()) {
  const auto number = [](int low, int high) { return static_cast<float>(*rc::gen::inRange(low, high)) / 100; };
  const auto path = [&]() -> Path {
    const Vector3f place(number(-150, 150), number(-150, 50), number(20, 120));
    const Vector3f size(number(0, 40), number(0, 40), number(0, 40));
    const auto pace = static_cast<double>(number(100, 1500)), phase = static_cast<double>(number(0, 628));
    return [=](double at) -> Vector3f { return place + size * static_cast<float>(std::sin(pace * at + phase)); };
  };
  const Palms palms{along(path(), number(0, 100)), along(path(), number(0, 100))};
  RC_ASSERT(class_of(palms) == class_of(mirrored(palms)));
}

}  // namespace
}  // namespace signweave
