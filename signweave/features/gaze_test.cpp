#include "signweave/features/gaze.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "signweave/rig/test_rig.h"

namespace signweave {
namespace {

constexpr float kRadian = std::numbers::pi_v<float> / 180;

/// The directions of two eyes at each frame, degrees.
struct Eyes {
  std::vector<Gaze> left;
  std::vector<Gaze> right;

  Gaze mean(std::size_t frame) const {
    return {(left[frame].yaw + right[frame].yaw) / 2, (left[frame].pitch + right[frame].pitch) / 2};
  }
  std::int64_t frames() const { return static_cast<std::int64_t>(left.size()); }
};

Eyes some_eyes(std::mt19937& random, std::size_t frames) {
  const auto angle = [&](float most) { return std::uniform_real_distribution<float>(-most, most)(random); };
  Eyes eyes;
  for (std::size_t i = 0; i < frames; ++i) {
    eyes.left.push_back({angle(30), angle(22)});
    eyes.right.push_back({angle(30), angle(22)});
  }
  return eyes;
}

/// A person with random movements, whose eyes move as given.
Motion with_joints(const Eyes& eyes) {
  Motion motion = moving(whole_person(), eyes.frames(), 7);
  const auto turned = [](Gaze gaze) {
    return Eigen::Quaternionf(Eigen::AngleAxisf(gaze.yaw * kRadian, Eigen::Vector3f::UnitY()) *
                              Eigen::AngleAxisf(-gaze.pitch * kRadian, Eigen::Vector3f::UnitX()));
  };
  const auto left = static_cast<std::size_t>(*motion.skeleton().find("LeftEye"));
  const auto right = static_cast<std::size_t>(*motion.skeleton().find("RightEye"));
  for (std::int64_t frame = 0; frame < eyes.frames(); ++frame) {
    motion.pose(frame).rotations[left] = turned(eyes.left[static_cast<std::size_t>(frame)]);
    motion.pose(frame).rotations[right] = turned(eyes.right[static_cast<std::size_t>(frame)]);
  }
  return motion;
}

Motion faceless(std::int64_t frames) {
  return Motion(
      std::make_shared<const Skeleton>(std::vector<Joint>{{"Root", kNoJoint, {0, 0, 0}, true}}, std::vector<Tip>{}),
      {60, 1}, frames);
}

template <typename Value>
void add(Motion& motion, const std::string& name, const std::vector<Gaze>& eye, Value&& value) {
  ScalarTrack track{.name = name, .values = {}};
  for (const Gaze& gaze : eye) track.values.push_back(value(gaze));
  motion.add_track(std::move(track));
}

/// The same eyes as recorded by Live Link Face: radians, positive to the right and down.
Motion with_rotations(const Eyes& eyes) {
  Motion motion = faceless(eyes.frames());
  add(motion, "leftEyeYaw", eyes.left, [](Gaze gaze) { return -gaze.yaw * kRadian; });
  add(motion, "leftEyePitch", eyes.left, [](Gaze gaze) { return -gaze.pitch * kRadian; });
  add(motion, "rightEyeYaw", eyes.right, [](Gaze gaze) { return -gaze.yaw * kRadian; });
  add(motion, "rightEyePitch", eyes.right, [](Gaze gaze) { return -gaze.pitch * kRadian; });
  return motion;
}

/// The same eyes as weights: "out" is away from the nose.
Motion with_weights(const Eyes& eyes) {
  Motion motion = faceless(eyes.frames());
  const auto up = [](Gaze gaze) { return std::max(gaze.pitch, 0.0f) / kLookUp; };
  const auto down = [](Gaze gaze) { return std::max(-gaze.pitch, 0.0f) / kLookDown; };
  const auto to_left = [](Gaze gaze) { return std::max(gaze.yaw, 0.0f) / kLookAcross; };
  const auto to_right = [](Gaze gaze) { return std::max(-gaze.yaw, 0.0f) / kLookAcross; };
  add(motion, "eyeLookOutLeft", eyes.left, to_left);
  add(motion, "eyeLookInLeft", eyes.left, to_right);
  add(motion, "eyeLookUpLeft", eyes.left, up);
  add(motion, "eyeLookDownLeft", eyes.left, down);
  add(motion, "eyeLookInRight", eyes.right, to_left);
  add(motion, "eyeLookOutRight", eyes.right, to_right);
  add(motion, "eyeLookUpRight", eyes.right, up);
  add(motion, "eyeLookDownRight", eyes.right, down);
  return motion;
}

struct MeasuredGaze {
  std::optional<GazeFrom> from;
  std::vector<Gaze> gaze;
};

MeasuredGaze measured_gaze(const Motion& motion) {
  const MemorySource source(motion);
  const std::optional<GazeSource> from = gaze_source(source, rig_of_signer(motion.skeleton()));
  if (!from) return {};
  return {from->from, gaze_over(source, *from, {0, motion.frame_count()})};
}

TEST(Gaze, LiveLinkFaceUsesRadiansToTheRightAndDown) {
  Motion motion = faceless(2);
  motion.add_track({.name = "leftEyeYaw", .values = {-0.1f, 0}});
  motion.add_track({.name = "leftEyePitch", .values = {0, 0.1f}});
  motion.add_track({.name = "rightEyeYaw", .values = {-0.2f, 0}});
  motion.add_track({.name = "rightEyePitch", .values = {0, 0.3f}});
  const MeasuredGaze result = measured_gaze(motion);
  ASSERT_EQ(result.from, GazeFrom::eye_tracks);
  EXPECT_NEAR(result.gaze[0].yaw, 8.5944f, 1e-3f);  // 0.15 radians to the left
  EXPECT_EQ(result.gaze[0].pitch, 0);
  EXPECT_NEAR(result.gaze[1].pitch, -11.4592f, 1e-3f);  // 0.2 radians down
  EXPECT_EQ(result.gaze[1].yaw, 0);
}

TEST(Gaze, AWeightIsAnAngleOfItsEye) {
  Motion motion = faceless(3);
  motion.add_track({.name = "eyeLookOutLeft", .values = {0.4f, 0, 0}});
  motion.add_track({.name = "eyeLookInRight", .values = {0.2f, 0, 0}});
  motion.add_track({.name = "eyeLookOutRight", .values = {0, 0.6f, 0}});
  motion.add_track({.name = "eyeLookUpLeft", .values = {0, 0.2f, 0}});
  motion.add_track({.name = "eyeLookUpRight", .values = {0, 0.2f, 0}});
  motion.add_track({.name = "eyeLookDownLeft", .values = {0, 0, 0.2f}});
  const MeasuredGaze result = measured_gaze(motion);
  ASSERT_EQ(result.from, GazeFrom::look_weights);
  EXPECT_NEAR(result.gaze[0].yaw, 10.5f, 1e-3f);    // (14 + 7) / 2
  EXPECT_NEAR(result.gaze[1].yaw, -10.5f, 1e-3f);   // (0 - 21) / 2
  EXPECT_NEAR(result.gaze[1].pitch, 5, 1e-3f);      // (5 + 5) / 2
  EXPECT_NEAR(result.gaze[2].pitch, -3.5f, 1e-3f);  // (-7 + 0) / 2
}

RC_GTEST_PROP(Gaze, AllSourcesGiveTheSameGaze, (std::uint32_t seed)) {
  std::mt19937 random(seed);
  const Eyes eyes = some_eyes(random, 8);
  const Motion motions[] = {with_joints(eyes), with_rotations(eyes), with_weights(eyes)};
  const GazeFrom expected[] = {GazeFrom::eye_joints, GazeFrom::eye_tracks, GazeFrom::look_weights};
  for (std::size_t i = 0; i < 3; ++i) {
    const MeasuredGaze result = measured_gaze(motions[i]);
    RC_ASSERT(result.from == expected[i]);
    for (std::size_t frame = 0; frame < eyes.left.size(); ++frame) {
      RC_ASSERT(std::abs(result.gaze[frame].yaw - eyes.mean(frame).yaw) < 0.01f);
      RC_ASSERT(std::abs(result.gaze[frame].pitch - eyes.mean(frame).pitch) < 0.01f);
    }
  }
}

RC_GTEST_PROP(Gaze, MirroringReversesTheYaw, (std::uint32_t seed)) {
  std::mt19937 random(seed);
  const Eyes eyes = some_eyes(random, 8);
  Eyes mirrored{eyes.right, eyes.left};
  for (Gaze& gaze : mirrored.left) gaze.yaw = -gaze.yaw;
  for (Gaze& gaze : mirrored.right) gaze.yaw = -gaze.yaw;
  const std::pair<MeasuredGaze, MeasuredGaze> pairs[] = {
      {measured_gaze(with_joints(eyes)), measured_gaze(in_mirror(with_joints(eyes)))},
      {measured_gaze(with_rotations(eyes)), measured_gaze(with_rotations(mirrored))},
      {measured_gaze(with_weights(eyes)), measured_gaze(with_weights(mirrored))}};
  for (const auto& [plain, other] : pairs) {
    RC_ASSERT(plain.gaze.size() == other.gaze.size());
    for (std::size_t frame = 0; frame < plain.gaze.size(); ++frame) {
      RC_ASSERT(std::abs(plain.gaze[frame].yaw + other.gaze[frame].yaw) < 0.01f);
      RC_ASSERT(std::abs(plain.gaze[frame].pitch - other.gaze[frame].pitch) < 0.01f);
    }
  }
}

TEST(Gaze, TheBestSourceIsUsed) {
  const Eyes eyes{{{10, 0}, {-5, 3}}, {{10, 0}, {-5, 3}}};
  Motion motion = with_joints(eyes);
  EXPECT_EQ(measured_gaze(motion).from, GazeFrom::eye_joints);
  motion.add_track({.name = "jawOpen", .values = {0.5f, 0.5f}});
  EXPECT_EQ(measured_gaze(motion).from, GazeFrom::eye_joints) << "a face without eye data";
  motion.add_track({.name = "eyeLookUpLeft", .values = {0.5f, 0.5f}});
  EXPECT_EQ(measured_gaze(motion).from, GazeFrom::look_weights);
  motion.add_track({.name = "rightEyeYaw", .values = {0.5f, 0.5f}});
  EXPECT_EQ(measured_gaze(motion).from, GazeFrom::eye_tracks);
  EXPECT_NEAR(measured_gaze(motion).gaze[1].yaw, -28.648f, 1e-2f) << "only one eye was captured";
}

TEST(Gaze, IsRelativeToTheHeadWhereverTheBodyIs) {
  const Eyes eyes{{{20, 5}, {-5, 3}}, {{20, 5}, {-5, 3}}};
  const MeasuredGaze here = measured_gaze(with_joints(eyes));
  const MeasuredGaze there = measured_gaze(placed(with_joints(eyes), 2.1f, {3, 0, -1}));
  ASSERT_EQ(here.gaze.size(), 2u);
  ASSERT_EQ(there.gaze.size(), 2u);
  for (std::size_t frame = 0; frame < 2; ++frame) {
    EXPECT_NEAR(here.gaze[frame].yaw, there.gaze[frame].yaw, 1e-2f);
    EXPECT_NEAR(here.gaze[frame].pitch, there.gaze[frame].pitch, 1e-2f);
  }
  EXPECT_NEAR(here.gaze[0].yaw, 20, 1e-2f);
}

TEST(Gaze, EyesThatNeverRotateWereNotCaptured) {
  const Eyes still{{{5, 0}, {5, 0}}, {{5, 0}, {5, 0}}};
  EXPECT_FALSE(measured_gaze(with_joints(still)).from);
  const Eyes one{{{5, 0}, {9, 0}}, {{0, 0}, {0, 0}}};
  const MeasuredGaze result = measured_gaze(with_joints(one));
  ASSERT_EQ(result.gaze.size(), 2u);
  EXPECT_NEAR(result.gaze[1].yaw, 9, 1e-2f) << "the other eye does not count";
}

TEST(Gaze, IsUnknownIfTheRestPoseDefinesNoAhead) {
  // Eyes that look sideways in the rest pose, for example because of a file's bind pose.
  const Eyes aside{{{80, 0}, {70, 0}}, {{80, 0}, {70, 0}}};
  EXPECT_FALSE(measured_gaze(with_joints(aside)).from);
  // A skeleton that lies on its back at rest.
  const Eyes eyes{{{20, 5}, {-5, 3}}, {{20, 5}, {-5, 3}}};
  const Motion motion = with_joints(eyes);
  std::vector<Joint> joints(motion.skeleton().joints().begin(), motion.skeleton().joints().end());
  std::vector<Tip> tips(motion.skeleton().tips().begin(), motion.skeleton().tips().end());
  const Eigen::Quaternionf down(Eigen::AngleAxisf(-std::numbers::pi_v<float> / 2, Eigen::Vector3f::UnitX()));
  for (Joint& joint : joints) joint.offset = down * joint.offset;
  Motion lying(std::make_shared<const Skeleton>(joints, tips), motion.rate(), 2);
  for (std::int64_t frame = 0; frame < 2; ++frame) {
    for (std::size_t joint = 0; joint < joints.size(); ++joint) {
      lying.pose(frame).rotations[joint] = motion.pose(frame).rotations[joint];
    }
  }
  EXPECT_FALSE(measured_gaze(lying).from);
  EXPECT_FALSE(measured_gaze(faceless(3)).from);
  EXPECT_FALSE(measured_gaze(faceless(0)).from);
}

TEST(Gaze, APartEqualsThatPartOfTheWhole) {
  std::mt19937 random(5);
  const Eyes eyes = some_eyes(random, 1'200);  // longer than one piece
  for (const Motion& motion : {with_joints(eyes), with_rotations(eyes), with_weights(eyes)}) {
    const MemorySource source(motion);
    const auto from = gaze_source(source, rig_of_signer(motion.skeleton()));
    ASSERT_TRUE(from);
    const std::vector<Gaze> all = gaze_over(source, *from, {0, 1'200});
    ASSERT_EQ(all.size(), 1'200u);
    EXPECT_EQ(gaze_over(source, *from, {500, 1'100}), std::vector<Gaze>(all.begin() + 500, all.begin() + 1'100));
    EXPECT_TRUE(gaze_over(source, *from, {7, 7}).empty());
  }
}

TEST(Gaze, NonFiniteValuesGiveNonFiniteGaze) {
  Motion motion = faceless(1);
  motion.add_track({.name = "leftEyeYaw", .values = {std::numeric_limits<float>::quiet_NaN()}});
  EXPECT_TRUE(std::isnan(measured_gaze(motion).gaze[0].yaw));
}

TEST(Gaze, StopsWhenThePauseThrows) {
  const Eyes eyes{{{20, 5}, {-5, 3}}, {{20, 5}, {-5, 3}}};
  const Motion motion = with_joints(eyes);
  const MemorySource source(motion);
  const Pause stop = [] { throw Error(ErrorCode::cancelled, "stop"); };
  EXPECT_THROW(gaze_source(source, rig_of_signer(motion.skeleton()), stop), Error);
  const auto from = gaze_source(source, rig_of_signer(motion.skeleton()));
  EXPECT_THROW(gaze_over(source, from.value(), {0, 2}, stop), Error);
}

}  // namespace
}  // namespace signweave
