#include "signweave/motion/kinematics.h"

#include <gtest/gtest.h>

#include <numbers>

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr float kQuarter = std::numbers::pi_v<float> / 2;

/// Hips at height 1, an arm of 0.3 + 0.2 along x, a hand whose tip is 0.1 further, and a second child of the hips.
Skeleton body() {
  return Skeleton({{"Hips", kNoJoint, {0, 1, 0}, true},
                   {"Arm", 0, {0.1f, 0.4f, 0}, false},
                   {"ForeArm", 1, {0.3f, 0, 0}, false},
                   {"Hand", 2, {0.2f, 0, 0}, false},
                   {"Leg", 0, {0.1f, -0.1f, 0}, true}},
                  {{3, {0.1f, 0, 0}}});
}

void expect_at(const Vector3f& is, const Vector3f& wanted) {
  EXPECT_LT((is - wanted).norm(), 1e-6f) << "is " << is.transpose() << ", should be " << wanted.transpose();
}

TEST(ToModelSpace, AddsOffsetsInTheRestPose) {
  const Skeleton skeleton = body();
  const ModelPose model = to_model_space(skeleton, Pose(skeleton).view());
  expect_at(model.positions[0], {0, 1, 0});
  expect_at(model.positions[3], {0.6f, 1.4f, 0});
  expect_at(model.positions[4], {0.1f, 0.9f, 0});
  expect_at(position_of(skeleton.tips()[0], model), {0.7f, 1.4f, 0});
}

TEST(ToModelSpace, TurnsEverythingBeyondAJointAboutThatJoint) {
  const Skeleton skeleton = body();
  Pose pose(skeleton);
  pose.rotations[1] = AngleAxisf(kQuarter, Vector3f::UnitZ());   // the arm up
  pose.rotations[2] = AngleAxisf(-kQuarter, Vector3f::UnitY());  // in the arm's space: forearm forward
  const ModelPose model = to_model_space(skeleton, pose.view());
  expect_at(model.positions[1], {0.1f, 1.4f, 0});
  expect_at(model.positions[2], {0.1f, 1.7f, 0});
  expect_at(model.positions[3], {0.1f, 1.7f, 0.2f});
  expect_at(position_of(skeleton.tips()[0], model), {0.1f, 1.7f, 0.3f});
  expect_at(model.positions[4], {0.1f, 0.9f, 0});  // the leg is on another branch
}

TEST(ToModelSpace, UsesATranslationInsteadOfTheOffset) {
  const Skeleton skeleton = body();
  Pose pose(skeleton);
  pose.translations[0] = {1, 2, 3};                             // the hips
  pose.translations[1] = {0, -0.5f, 0};                         // the leg, in the hips' space
  pose.rotations[0] = AngleAxisf(kQuarter, Vector3f::UnitX());  // y becomes z, z becomes −y
  const ModelPose model = to_model_space(skeleton, pose.view());
  expect_at(model.positions[0], {1, 2, 3});
  expect_at(model.positions[4], {1, 2, 2.5f});
  expect_at(model.positions[1], {1.1f, 2, 3.4f});
}

TEST(ToModelSpace, ReusesItsMemory) {
  const Skeleton skeleton = body();
  Pose pose(skeleton);
  ModelPose model;
  to_model_space(skeleton, pose.view(), model);
  const Vector3f* room = model.positions.data();
  pose.translations[0].x() = 5;
  to_model_space(skeleton, pose.view(), model);
  EXPECT_EQ(model.positions.data(), room);
  expect_at(model.positions[0], {5, 1, 0});
}

TEST(ToModelSpace, KeepsBoneLengthsWhateverTheRotations) {
  const Skeleton skeleton = body();
  Pose pose(skeleton);
  for (std::size_t i = 0; i < pose.rotations.size(); ++i) {
    const auto number = static_cast<float>(i);
    pose.rotations[i] = AngleAxisf(0.7f + number, Vector3f(1, number, -2).normalized());
  }
  const ModelPose model = to_model_space(skeleton, pose.view());
  EXPECT_NEAR((model.positions[2] - model.positions[1]).norm(), 0.3f, 1e-6f);
  EXPECT_NEAR((model.positions[3] - model.positions[2]).norm(), 0.2f, 1e-6f);
  EXPECT_NEAR((position_of(skeleton.tips()[0], model) - model.positions[3]).norm(), 0.1f, 1e-6f);
}

TEST(JointChains, ComputeTheRequestedJointsAndTheirAncestorsToTheSameBits) {
  const Skeleton skeleton = body();
  Pose pose(skeleton);
  for (std::size_t i = 0; i < pose.rotations.size(); ++i) {
    const auto number = static_cast<float>(i);
    pose.rotations[i] = AngleAxisf(0.3f + number, Vector3f(number, 1, 2).normalized());
  }
  pose.translations[0] = {1, 2, 3};
  pose.translations[1] = {0.1f, -0.2f, 0};  // the leg's translation, whose index counts that of the hips, too
  const ModelPose whole = to_model_space(skeleton, pose.view());
  const auto expect_same = [&](const std::vector<JointIndex>& requested, const JointSet& computed) {
    const JointChains chains(skeleton, requested);
    EXPECT_EQ(chains.joints(), computed);
    ModelPose model;
    chains.to_model_space(pose.view(), model);
    ASSERT_EQ(model.positions.size(), skeleton.joint_count());
    for (const JointIndex joint : computed) {
      const auto i = static_cast<std::size_t>(joint);
      EXPECT_EQ(model.positions[i], whole.positions[i]);
      EXPECT_EQ(model.rotations[i].coeffs(), whole.rotations[i].coeffs());
    }
  };
  expect_same({4, 4}, {0, 4});
  expect_same({3, 0}, {0, 1, 2, 3});
  expect_same({2, 4}, {0, 1, 2, 4});
  expect_same({}, {});

  // Below a joint, in its own space.
  const JointChains below(skeleton, std::vector<JointIndex>{3}, 1);
  EXPECT_EQ(below.joints(), (JointSet{1, 2, 3}));
  ModelPose model;
  below.to_model_space(pose.view(), model);
  for (const std::size_t i : {1u, 2u, 3u}) {
    const Eigen::Quaternionf to_top = whole.rotations[1].conjugate();
    EXPECT_LT((model.positions[i] - to_top * (whole.positions[i] - whole.positions[1])).norm(), 1e-5f);
    EXPECT_LT(model.rotations[i].angularDistance(to_top * whole.rotations[i]), 1e-3f);
  }
}

}  // namespace
}  // namespace signweave
