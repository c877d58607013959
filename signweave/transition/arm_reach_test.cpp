#include "signweave/transition/arm_reach.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "signweave/transition/test_gap_motion.h"

namespace signweave {
namespace {

using namespace testing_gap;

constexpr ArmJoints kArm{kUpper, kFore, kHand};
constexpr float kLengthOfUpper = 0.3f;
constexpr float kLengthOfFore = 0.25f;

/// The small body's left arm, with its elbow bent by an angle.
Motion arm_bent_by(float angle, const Eigen::Vector3f& axis) {
  Motion motion(body(), {100, 1}, 1);
  motion.pose(0).rotations[kUpper] = about({0.3f, -1, 0.4f}, 0.7);
  motion.pose(0).rotations[kFore] = Eigen::Quaternionf(Eigen::AngleAxisf(angle, axis));
  motion.pose(0).rotations[kHand] = about({1, 0.2f, 0}, -0.4);
  return motion;
}

float elbow_of(const ModelPose& model) {
  const Eigen::Vector3f upper = model.positions[kUpper] - model.positions[kFore];
  const Eigen::Vector3f fore = model.positions[kHand] - model.positions[kFore];
  return std::acos(upper.dot(fore) / (upper.norm() * fore.norm()));
}

RC_GTEST_PROP(ArmReach, AWristIsShiftedAsFarAsTheArmReaches, ()) {
  const auto random = [](int most) { return 0.001f * static_cast<float>(*rc::gen::inRange(-most, most)); };
  const Eigen::Vector3f axis = Eigen::Vector3f(0.01f * random(1000), 1, random(1000)).normalized();
  Motion motion = arm_bent_by(1.6f + random(1100), axis);
  const ModelPose before = to_model_space(motion.skeleton(), motion.pose(0));
  const Eigen::Vector3f by(random(200), random(200), random(200));
  shift_wrist(motion.skeleton(), kArm, before, by, motion.pose(0));
  const ModelPose after = to_model_space(motion.skeleton(), motion.pose(0));
  RC_ASSERT(after.rotations[kHand].angularDistance(before.rotations[kHand]) < 2e-3f);
  const Eigen::Vector3f goal = before.positions[kHand] + by - before.positions[kUpper];
  const auto distance_at = [](double between) {
    return std::sqrt(kLengthOfUpper * kLengthOfUpper + kLengthOfFore * kLengthOfFore -
                     2 * kLengthOfUpper * kLengthOfFore * std::cos(between));
  };
  const double nearest = distance_at(std::min(0.5, double{elbow_of(before)}));
  const double farthest = distance_at(std::max(3.1, double{elbow_of(before)}));
  const double wanted = std::clamp(double{goal.norm()}, nearest, farthest);
  const Eigen::Vector3f reached = after.positions[kHand] - after.positions[kUpper];
  RC_ASSERT((reached - static_cast<float>(wanted) * goal.normalized()).norm() < 5e-4f);
}

TEST(ArmReach, AZeroShiftMovesNothing) {
  for (const float angle : {0.0f, 1e-3f, 0.1f, 1.5f, 2.8f, 3.1f}) {
    Motion motion = arm_bent_by(angle, Eigen::Vector3f::UnitY());
    const Motion as_it_was = motion;
    shift_wrist(motion.skeleton(), kArm, to_model_space(motion.skeleton(), motion.pose(0)), Eigen::Vector3f::Zero(),
                motion.pose(0));
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      EXPECT_LT(motion.pose(0).rotations[joint].angularDistance(as_it_was.pose(0).rotations[joint]), 1e-3f)
          << angle << ' ' << joint;
    }
  }
}

TEST(ArmReach, SmallShiftsMoveJointsLittleAtAnyElbowAngle) {
  for (float angle = 0.2f; angle < 2.6f; angle += 0.05f) {
    Motion motion = arm_bent_by(angle, Eigen::Vector3f::UnitY());
    const Motion as_it_was = motion;
    shift_wrist(motion.skeleton(), kArm, to_model_space(motion.skeleton(), motion.pose(0)), {1e-3f, -1e-3f, 1e-3f},
                motion.pose(0));
    for (const std::size_t joint : {kUpper, kFore, kHand}) {
      EXPECT_LT(motion.pose(0).rotations[joint].angularDistance(as_it_was.pose(0).rotations[joint]), 0.08f)
          << angle << ' ' << joint;
    }
  }
}

}  // namespace
}  // namespace signweave
