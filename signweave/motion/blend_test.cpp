#include "signweave/motion/blend.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr float kPi = std::numbers::pi_v<float>;

rc::Gen<float> within(float low, float high) {
  return rc::gen::map(rc::gen::inRange(0, 1'000'001),
                      [=](int i) { return low + (high - low) * static_cast<float>(i) * 1e-6f; });
}

rc::Gen<Quaternionf> any_rotation() {
  return rc::gen::map(rc::gen::tuple(within(-1, 1), within(-1, 1), within(-1, 1), within(-1, 1)), [](const auto& four) {
    Quaternionf q(std::get<0>(four), std::get<1>(four), std::get<2>(four), std::get<3>(four));
    if (q.norm() < 1e-3f) return Quaternionf::Identity();
    return q.normalized();
  });
}

float angle_between(const Quaternionf& a, const Quaternionf& b) {
  const Quaternionf turn = a.conjugate() * b;
  return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
}

std::shared_ptr<const Skeleton> skeleton() {
  return std::make_shared<const Skeleton>(
      std::vector<Joint>{{"Hips", kNoJoint, {0, 1, 0}, true}, {"Arm", 0, {1, 0, 0}, false}}, std::vector<Tip>{});
}

/// The root moves one metre per frame along x and turns by 0.1 about y; the arm turns by 0.2 about z.
Motion walk(std::int64_t frames) {
  Motion motion(skeleton(), {100, 1}, frames);
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const auto number = static_cast<float>(frame);
    motion.pose(frame).translations[0] = {number, 1, 0};
    motion.pose(frame).rotations[0] = AngleAxisf(0.1f * number, Vector3f::UnitY());
    motion.pose(frame).rotations[1] = AngleAxisf(0.2f * number, Vector3f::UnitZ());
  }
  return motion;
}

TEST(Slerp, FollowsTheHandComputedArc) {
  const Quaternionf a = Quaternionf::Identity();
  const Quaternionf b(AngleAxisf(kPi / 2, Vector3f::UnitY()));
  const Quaternionf third = slerp(a, b, 1.0f / 3);
  EXPECT_NEAR(third.w(), std::cos(kPi / 12), 1e-6f);
  EXPECT_NEAR(third.y(), std::sin(kPi / 12), 1e-6f);
  EXPECT_EQ(third.x(), 0);
  EXPECT_EQ(third.z(), 0);
}

RC_GTEST_PROP(Slerp, IsUnitAndDividesTheShortestArcEvenly, ()) {
  const Quaternionf a = *any_rotation();
  const Quaternionf b = *any_rotation();
  const float t = *within(0, 1);
  const Quaternionf between = slerp(a, b, t);
  RC_ASSERT(std::abs(between.norm() - 1) < 1e-6f);
  const float whole = angle_between(a, b);
  // Half a turn apart all arcs are equally short; just below that, rounding decides.
  RC_PRE(whole < kPi - 0.01f);
  RC_ASSERT(std::abs(angle_between(a, between) - t * whole) < 2e-5f);
  RC_ASSERT(std::abs(angle_between(between, b) - (1 - t) * whole) < 2e-5f);
}

RC_GTEST_PROP(Slerp, IsExactAtItsEnds, ()) {
  const Quaternionf a = *any_rotation();
  const Quaternionf b = *any_rotation();
  RC_ASSERT(slerp(a, b, 0).coeffs() == a.coeffs());
  const Quaternionf end = slerp(a, b, 1);
  RC_ASSERT(end.coeffs() == b.coeffs() || end.coeffs() == -b.coeffs());
  RC_ASSERT(slerp(a, a, *within(0, 1)).isApprox(a, 1e-6f));
}

RC_GTEST_PROP(Slerp, DoesNotDependOnTheSignOfTheEnd, ()) {
  const Quaternionf a = *any_rotation();
  const Quaternionf b = *any_rotation();
  RC_PRE(std::abs(a.dot(b)) > 1e-3f);
  const float t = *within(0, 1);
  RC_ASSERT(slerp(a, b, t).coeffs().isApprox(slerp(a, Quaternionf(-b.coeffs()), t).coeffs(), 1e-6f));
}

TEST(Slerp, HasConstantSpeedOnAShortArc) {
  // On both sides of the angle at which the arc is approximated by a line.
  for (const float angle : {1e-4f, 0.03f, 0.0632f, 0.0633f, 0.1f}) {
    const Quaternionf b(AngleAxisf(angle, Vector3f::UnitX()));
    for (const float t : {0.25f, 0.5f, 0.9f}) {
      EXPECT_NEAR(angle_between(Quaternionf::Identity(), slerp(Quaternionf::Identity(), b, t)), t * angle, 1e-6f)
          << angle;
    }
  }
}

TEST(Blend, MayWriteIntoEitherOfItsSources) {
  const Motion motion = walk(2);
  Pose wanted(motion.pose(0));
  blend(motion.pose(0), motion.pose(1), 0.25f, wanted.view());
  Pose into_first(motion.pose(0));
  blend(into_first.view(), motion.pose(1), 0.25f, into_first.view());
  Pose into_second(motion.pose(1));
  blend(motion.pose(0), into_second.view(), 0.25f, into_second.view());
  for (const Pose* pose : {&into_first, &into_second}) {
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(pose->rotations[i].coeffs(), wanted.rotations[i].coeffs());
    EXPECT_EQ(pose->translations[0], wanted.translations[0]);
  }
  EXPECT_FLOAT_EQ(wanted.translations[0].x(), 0.25f);
  EXPECT_NEAR(angle_between(wanted.rotations[1], Quaternionf::Identity()), 0.05f, 1e-6f);
}

TEST(Sample, IsExactAtWholeFramesAndClampsOutsideTheMotion) {
  const Motion motion = walk(5);
  Pose pose(motion.skeleton());
  const auto expect_frame = [&](double at, std::int64_t frame) {
    sample(motion, at, pose.view());
    EXPECT_EQ(pose.rotations[1].coeffs(), motion.pose(frame).rotations[1].coeffs()) << at;
    EXPECT_EQ(pose.translations[0], motion.pose(frame).translations[0]) << at;
  };
  for (std::int64_t frame = 0; frame < 5; ++frame) expect_frame(static_cast<double>(frame), frame);
  expect_frame(-3.5, 0);
  expect_frame(4.2, 4);
  expect_frame(1e18, 4);
}

TEST(Sample, IsBetweenItsNeighbours) {
  const Motion motion = walk(5);
  Pose pose(motion.skeleton());
  sample(motion, 2.75, pose.view());
  EXPECT_FLOAT_EQ(pose.translations[0].x(), 2.75f);
  EXPECT_NEAR(angle_between(pose.rotations[1], Quaternionf::Identity()), 0.55f, 1e-6f);
  // A motion of one frame has that pose at all times.
  sample(walk(1), 0.5, pose.view());
  EXPECT_EQ(pose.translations[0].x(), 0);
}

TEST(StandingOver, IsTheMeanPlaceOnTheGroundAndTheMeanHeading) {
  const Standing standing = standing_over(walk(5), {1, 4});
  EXPECT_TRUE(standing.position.isApprox(Vector3f(2, 0, 0), 1e-6f));
  EXPECT_NEAR(standing.heading, 0.2f, 1e-6f);
}

TEST(StandingOver, TakesTheCircularMeanOfHeadings) {
  Motion motion(skeleton(), {100, 1}, 2);
  motion.pose(0).rotations[0] = AngleAxisf(kPi - 0.1f, Vector3f::UnitY());
  motion.pose(1).rotations[0] = AngleAxisf(-kPi + 0.1f, Vector3f::UnitY());
  EXPECT_NEAR(std::abs(standing_over(motion, {0, 2}).heading), kPi, 1e-5f);
  motion.pose(1).rotations[0].coeffs() *= -1;  // the same rotation
  EXPECT_NEAR(std::abs(standing_over(motion, {0, 2}).heading), kPi, 1e-5f);
}

TEST(StandingOver, IgnoresLeaning) {
  Motion motion(skeleton(), {100, 1}, 1);
  motion.pose(0).rotations[0] =
      Quaternionf(AngleAxisf(0.8f, Vector3f::UnitY())) * Quaternionf(AngleAxisf(0.5f, Vector3f::UnitX()));
  EXPECT_NEAR(standing_over(motion, {0, 1}).heading, 0.8f, 1e-5f);
}

TEST(Align, MovesAQuarterTurnByHand) {
  const Standing from{.position = {1, 0, 0}, .heading = 0};
  const Standing to{.position = {5, 0, 7}, .heading = kPi / 2};
  const GroundTransform transform = align(from, to);
  Pose pose(*skeleton());
  pose.translations[0] = {1, 0.9f, 2};  // two metres in front of the standing
  apply(transform, *skeleton(), pose.view());
  // In front is now +x, and the height is unchanged.
  EXPECT_TRUE(pose.translations[0].isApprox(Vector3f(7, 0.9f, 7), 1e-5f)) << pose.translations[0].transpose();
  EXPECT_EQ(pose.rotations[1].coeffs(), Quaternionf::Identity().coeffs());
}

TEST(Align, TurnsARootWithoutTranslationAndLeavesTheOthers) {
  const auto fixed = std::make_shared<const Skeleton>(
      std::vector<Joint>{{"Hips", kNoJoint, {0, 1, 0}, false}, {"Spine", 0, {0.3f, 0, 0}, true}}, std::vector<Tip>{});
  Motion motion(fixed, {100, 1}, 2);
  for (std::int64_t frame = 0; frame < 2; ++frame) motion.pose(frame).translations[0] = {0.3f, 0.1f, 0.2f};
  EXPECT_EQ(standing_over(motion, {0, 2}).position, Vector3f::Zero());
  const Standing there{.position = {5, 0, 7}, .heading = kPi / 2};
  apply(align(standing_over(motion, {0, 2}), there), *fixed, motion.pose(0));
  EXPECT_EQ(motion.pose(0).translations[0], Vector3f(0.3f, 0.1f, 0.2f));  // the spine's offset from the hips
  EXPECT_NEAR(standing_over(motion, {0, 1}).heading, kPi / 2, 1e-5f);
}

RC_GTEST_PROP(Align, MovesASignerToAnotherStanding, ()) {
  const auto somewhere = [] {
    return Standing{.position = {*within(-5, 5), 0, *within(-5, 5)}, .heading = *within(-3.1f, 3.1f)};
  };
  const Standing from = somewhere();
  const Standing to = somewhere();
  Motion motion(skeleton(), {100, 1}, 1);
  motion.pose(0).translations[0] = from.position + Vector3f(0, 1, 0);
  motion.pose(0).rotations[0] = AngleAxisf(from.heading, Vector3f::UnitY());
  apply(align(from, to), motion.skeleton(), motion.pose(0));
  const Standing now = standing_over(motion, {0, 1});
  RC_ASSERT((now.position - to.position).norm() < 1e-5f);
  RC_ASSERT(std::abs(std::remainder(now.heading - to.heading, 2 * kPi)) < 1e-5f);
  RC_ASSERT(motion.pose(0).translations[0].y() == 1.0f);
}

}  // namespace
}  // namespace signweave
