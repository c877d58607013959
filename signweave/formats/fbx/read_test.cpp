#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "signweave/core/atomic_file.h"
#include "signweave/formats/fbx/fbx.h"
#include "signweave/formats/fbx/test_text.h"
#include "signweave/motion/kinematics.h"

namespace signweave::fbx {
namespace {

using Eigen::Vector3d;
using test::kSecond;
using test::TestCurve;
using test::TestFile;
using test::TestNode;

const std::filesystem::path kArm = std::filesystem::path(SIGNWEAVE_SOURCE_DIR) / "testdata" / "fbx" / "arm.fbx";

void expect_same_point(const Eigen::Vector3f& found, const Eigen::Vector3f& expected) {
  EXPECT_LT((found - expected).norm(), 1e-6f) << found.transpose() << " instead of " << expected.transpose();
}

std::string fbx_fault(const std::string& text, const ReadOptions& options = {}) {
  try {
    read_bytes("made", text, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "no fault";
}

/// A hand on an arm; the arm turns by 10 degrees about z from frame 0 to 1, at 30 frames a second.
TestFile two_bones() {
  TestFile file;
  TestNode arm{.name = "Arm"};
  arm.translation = Vector3d(0, 100, 0);
  arm.curves[1][2] = {.ticks = {0, kSecond / 30}, .values = {0, 10}, .attributes = {}};
  TestNode hand{.name = "Hand", .type = "LimbNode", .parent = 0};
  hand.translation = Vector3d(20, 0, 0);
  file.nodes = {arm, hand};
  return file;
}

std::vector<std::string> texts_of_notices(const std::vector<Notice>& notices) {
  std::vector<std::string> texts;
  for (const Notice& notice : notices) texts.push_back(notice.text);
  return texts;
}

// The rig scales by 2. The shoulder is at 2 * (10, 50, 0) cm and its pre-rotation turns x to y, so the elbow is 2 * 15
// cm above it. The elbow turns by its angle about z, then back by its post-rotation of 90 degrees about x, which takes
// the hand's y to -z (turned in the shoulder's space: z stays z): the hand is 20 cm behind the elbow, whatever the
// angle.
TEST(FbxRead, BonesAreAtTheHandComputedPositions) {
  const File file = read(kArm);
  ASSERT_EQ(file.motion.frame_count(), 3);
  EXPECT_EQ(file.take, "Take 001");
  const Skeleton& skeleton = file.motion.skeleton();
  ASSERT_EQ(skeleton.joint_count(), 4u);
  EXPECT_EQ(skeleton.joint(0).name, "Rig");
  EXPECT_EQ(skeleton.joint(1).name, "Someone:Shoulder");
  for (std::int64_t frame = 0; frame < 3; ++frame) {
    const ModelPose pose = to_model_space(skeleton, file.motion.pose(frame));
    expect_same_point(pose.positions[1], {0.2f, 1.0f, 0.0f});
    expect_same_point(pose.positions[2], {0.2f, 1.3f, 0.0f});
    expect_same_point(pose.positions[3], {0.2f, 1.3f, -0.2f});
  }
  // In the last frame the elbow has turned by 90 degrees: its x, first up, points left.
  const ModelPose last = to_model_space(skeleton, file.motion.pose(2));
  expect_same_point(last.rotations[2] * Eigen::Vector3f::UnitX(), {-1, 0, 0});
  // No length changes over time, so every length is an offset.
  EXPECT_EQ(skeleton.translation_count(), 0u);
  ASSERT_EQ(file.motion.tracks().size(), 1u);
  EXPECT_EQ(file.motion.tracks()[0], (ScalarTrack{"jawOpen", {0.0f, 0.5f, 1.0f}}));
}

// arm_7400.fbx and arm_7700.fbx are arm.fbx in binary, the second with 64-bit positions and compressed arrays.
TEST(FbxRead, TextAndBinaryAreTheSameMotion) {
  const File text = read(kArm);
  for (const char* name : {"arm_7400.fbx", "arm_7700.fbx"}) {
    const File binary = read(kArm.parent_path() / name);
    EXPECT_TRUE(same_bits(binary.motion, text.motion)) << name;
    EXPECT_EQ(binary.take, text.take);
    EXPECT_EQ(texts_of_notices(binary.notices), texts_of_notices(text.notices));
  }
}

TEST(FbxRead, OneTakeIsReadAndTheOthersAreNamed) {
  const File first = read(kArm);
  EXPECT_THAT(texts_of_notices(first.notices), testing::Contains("take 1 'Take 001' is read; others: 2 'wave'"));
  const File second = read(kArm, {.take = "wave"});
  EXPECT_EQ(second.take, "wave");
  EXPECT_EQ(second.motion.frame_count(), 1);
  EXPECT_TRUE(same_bits(second.motion, read(kArm, {.take = "2"}).motion));
  EXPECT_FALSE(same_bits(second.motion, first.motion.slice({0, 1})));
  EXPECT_TRUE(second.motion.tracks().empty());
}

TEST(FbxRead, AMissingTakeIsNotFound) {
  for (const char* take : {"3", "0", "-1", "wav"}) {
    try {
      read(kArm, {.take = take});
      FAIL() << take;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::not_found);
      EXPECT_THAT(error.what(), testing::HasSubstr("; it has 1 'Take 001', 2 'wave'"));
    }
  }
}

TEST(FbxRead, TheUnitOfTheFileAndThatOfTheUserScaleLengths) {
  TestFile file = two_bones();
  file.settings = TestFile::axes(1, 1, 2, 1, 0, 1) + TestFile::unit(2.54) + TestFile::time_mode(6);
  const std::string text = test::text_of(file);
  EXPECT_FLOAT_EQ(read_bytes("made", text).motion.skeleton().joint(1).offset.x(), 0.508f);
  EXPECT_FLOAT_EQ(read_bytes("made", text, {.take = "", .unit = 0.5}).motion.skeleton().joint(1).offset.x(), 10.0f);
  EXPECT_NE(fbx_fault(text, {.take = "", .unit = -1.0}).find("is not a unit"), std::string::npos);
}

TEST(FbxRead, ZUpIsTurnedToYUpAndReported) {
  TestFile file = two_bones();
  file.settings = TestFile::axes(2, 1, 1, -1, 0, 1) + TestFile::unit(1) + TestFile::time_mode(6);
  file.nodes[0].translation = Vector3d(1, 2, 3);
  const File read = read_bytes("made", test::text_of(file));
  expect_same_point(read.motion.skeleton().joint(0).offset, {0.01f, 0.03f, -0.02f});
  EXPECT_THAT(texts_of_notices(read.notices),
              testing::ElementsAre("turned to Y up: its right is +X, its up +Z, its front -Y"));
}

TEST(FbxRead, TheFrameRateIsTheFilesElseThatOfItsKeys) {
  TestFile file = two_bones();
  const auto rate_with = [&](const std::string& settings) {
    file.settings = TestFile::axes(1, 1, 2, 1, 0, 1) + TestFile::unit(1) + settings;
    return read_bytes("made", test::text_of(file)).motion.rate();
  };
  EXPECT_EQ(rate_with(TestFile::time_mode(3)), (FrameRate{60, 1}));
  EXPECT_EQ(rate_with(TestFile::time_mode(9)), (FrameRate{30000, 1001}));
  EXPECT_EQ(rate_with(TestFile::time_mode(14) + TestFile::number("CustomFrameRate", 59.94005994)),
            (FrameRate{60000, 1001}));
  EXPECT_EQ(rate_with(TestFile::time_mode(14) + TestFile::number("CustomFrameRate", 12.5)), (FrameRate{25, 2}));
  EXPECT_EQ(rate_with(TestFile::time_mode(0)), (FrameRate{30, 1}));
  file.nodes[0].curves[1][2].ticks = {0, kSecond / 100};
  EXPECT_EQ(rate_with(TestFile::time_mode(0)), (FrameRate{100, 1}));
  const File wanted = read_bytes("made", test::text_of(file), {.take = "", .rate = FrameRate{50, 1}});
  EXPECT_EQ(wanted.motion.rate(), (FrameRate{50, 1}));
}

/// The angle about z of the arm of two_bones in each frame at 30 frames a second, in degrees.
std::vector<double> angles_of(const TestCurve& curve) {
  TestFile file = two_bones();
  file.nodes[0].curves[1][2] = curve;
  const File read = read_bytes("made", test::text_of(file));
  std::vector<double> angles;
  for (std::int64_t frame = 0; frame < read.motion.frame_count(); ++frame) {
    const Eigen::Vector3d x = read.motion.pose(frame).rotations[0].cast<double>() * Vector3d::UnitX();
    angles.push_back(std::atan2(x.y(), x.x()) * 180 / 3.14159265358979);
  }
  return angles;
}

std::string attributes(int flags, const char* data) {
  return fmt::format(
      "KeyAttrFlags: *1 {{\n a: {}\n}}\nKeyAttrDataFloat: *4 {{\n a: {}\n}}\nKeyAttrRefCount: *1 {{\n a: 2\n}}\n",
      flags, data);
}

// Keys 0 and 40 four frames apart.
TEST(FbxRead, BetweenKeysTheCurveFollowsTheKeys) {
  const auto angles = [](const std::string& text) {
    return angles_of({.ticks = {0, 4 * (kSecond / 30)}, .values = {0, 40}, .attributes = text});
  };
  using testing::DoubleNear;
  const auto are = [](double a, double b, double c, double d, double e) {
    return testing::ElementsAre(DoubleNear(a, 1e-3), DoubleNear(b, 1e-3), DoubleNear(c, 1e-3), DoubleNear(d, 1e-3),
                                DoubleNear(e, 1e-3));
  };
  EXPECT_THAT(angles(""), are(0, 10, 20, 30, 40));
  EXPECT_THAT(angles(attributes(0x4, "0,0,0,0")), are(0, 10, 20, 30, 40));
  EXPECT_THAT(angles(attributes(0x2, "0,0,0,0")), are(0, 0, 0, 0, 40));
  EXPECT_THAT(angles(attributes(0x102, "0,0,0,0")), are(0, 40, 40, 40, 40));
  // Level tangents: 40 (3 u² - 2 u³).
  EXPECT_THAT(angles(attributes(0x408, "0,0,0,0")), are(0, 6.25, 20, 33.75, 40));
  // A slope of 300 a second at the beginning, which is 40 over the four frames: adds 40 (u³ - 2 u² + u).
  EXPECT_THAT(angles(attributes(0x408, "300,0,0,0")), are(0, 11.875, 25, 35.625, 40));
  // Both weights are a third, in ten-thousandths, which equals no weights. 3333 * 65536 + 3333.
  EXPECT_THAT(angles(attributes(0x3000408, "300,0,218434821,0")), are(0, 11.875, 25, 35.625, 40));
  // Long level tangents: even slower at the beginning. At u = 1/2 it is in the middle, by symmetry.
  const std::vector<double> heavy = angles(attributes(0x3000408, "0,0,524296000,0"));
  EXPECT_LT(heavy[1], 5.5);
  EXPECT_NEAR(heavy[2], 20, 1e-3);
}

TEST(FbxRead, TheTakesRangeIsReadAndKeysOutsideStillShapeIt) {
  TestFile file = two_bones();
  file.nodes[0].curves[1][2] = {.ticks = {0, 4 * (kSecond / 30)}, .values = {0, 40}, .attributes = {}};
  file.stack = TestFile::whole("LocalStart", kSecond / 30) + TestFile::whole("LocalStop", 3 * (kSecond / 30));
  const File read = read_bytes("made", test::text_of(file));
  ASSERT_EQ(read.motion.frame_count(), 3);
  EXPECT_NEAR(read.motion.pose(0).rotations[0].angularDistance(Eigen::Quaternionf::Identity()) * 180 / 3.14159f, 10,
              1e-3);
  EXPECT_THAT(texts_of_notices(read.notices),
              testing::Contains(testing::HasSubstr("keys before its start or after its stop")));
}

TEST(FbxRead, OnlyABoneWhoseLengthChangesIsTranslated) {
  TestFile file = two_bones();
  file.nodes[1].curves[0][0] = {.ticks = {0, kSecond / 30}, .values = {20, 25}, .attributes = {}};
  const File read = read_bytes("made", test::text_of(file));
  ASSERT_EQ(read.motion.skeleton().translation_count(), 1u);
  EXPECT_TRUE(read.motion.skeleton().joint(1).translated);
  expect_same_point(read.motion.pose(1).translations[0], {0.25f, 0, 0});
}

// The value of a component without a curve is the curve node's, or else the node's own: never 0.
TEST(FbxRead, ComponentsWithoutACurveKeepTheirOwnValue) {
  TestFile file = two_bones();
  file.nodes[0].curves[0][1] = {.ticks = {0, kSecond / 30}, .values = {100, 101}, .attributes = {}};
  file.nodes[0].translation = Vector3d(7, 100, 9);
  const File read = read_bytes("made", test::text_of(file));
  expect_same_point(read.motion.pose(1).translations[0], {0.07f, 1.01f, 0.09f});
}

TEST(FbxRead, NodesWithOneNameStayDistinct) {
  TestFile file = two_bones();
  file.nodes[1].name = "Arm";
  file.nodes[1].curves[1][0] = {.ticks = {0, kSecond / 30}, .values = {0, 50}, .attributes = {}};
  const File read = read_bytes("made", test::text_of(file));
  const auto pose = read.motion.pose(1);
  EXPECT_NEAR(pose.rotations[0].angularDistance(Eigen::Quaternionf::Identity()) * 180 / 3.14159f, 10, 1e-3);
  EXPECT_NEAR(pose.rotations[1].angularDistance(Eigen::Quaternionf::Identity()) * 180 / 3.14159f, 50, 1e-3);
}

TEST(FbxRead, AScaleThatLengthensBonesIsRefusedWithItsNode) {
  TestFile file = two_bones();
  file.nodes[0].scaling = Vector3d(1, 2, 1);
  EXPECT_THAT(fbx_fault(test::text_of(file)),
              testing::HasSubstr("node 'Arm' is scaled by 1, 2, 1 and has bones below it, which would be stretched"));
  file.nodes[0].scaling = Vector3d::Ones();
  file.nodes[0].curves[2][1] = {.ticks = {0, kSecond / 30}, .values = {1, 3}, .attributes = {}};
  EXPECT_THAT(fbx_fault(test::text_of(file)), testing::HasSubstr("node 'Arm' is scaled by 1, 3, 1 in frame 1"));
  file.nodes[0].curves[2] = {};
  file.nodes[0].scaling = -Vector3d::Ones();
  EXPECT_THAT(fbx_fault(test::text_of(file)), testing::HasSubstr("mirrored"));
  file.nodes[0].scaling = Vector3d::Ones();
  file.nodes[1].scaling = Vector3d(1, 2, 3);  // the hand has no children
  EXPECT_EQ(fbx_fault(test::text_of(file)), "no fault");
}

TEST(FbxRead, AnimatedUniformScaleChangesTheLengths) {
  TestFile file = two_bones();
  for (TestCurve& curve : file.nodes[0].curves[2])
    curve = {.ticks = {0, kSecond / 30}, .values = {1, 3}, .attributes = {}};
  const File read = read_bytes("made", test::text_of(file));
  expect_same_point(read.motion.pose(0).translations[0], {0.2f, 0, 0});
  expect_same_point(read.motion.pose(1).translations[0], {0.6f, 0, 0});
}

// InheritType 2: the children of the middle node do not inherit the scale of the middle's parent, but the position of
// the middle node does.
TEST(FbxRead, ANodeThatDoesNotInheritItsParentsScaleDoesNotPassItOn) {
  TestFile file = two_bones();
  file.nodes[0].scaling = Vector3d::Constant(2);
  file.nodes[1].properties = TestFile::whole("InheritType", 2);
  TestNode finger{.name = "Finger", .type = "LimbNode", .parent = 1};
  finger.translation = Vector3d(5, 0, 0);
  file.nodes.push_back(finger);
  const File read = read_bytes("made", test::text_of(file));
  expect_same_point(read.motion.skeleton().joint(1).offset, {0.4f, 0, 0});
  expect_same_point(read.motion.skeleton().joint(2).offset, {0.05f, 0, 0});
}

TEST(FbxRead, OfSeveralTreesTheLargestIsReadAndTheOthersAreNamed) {
  TestFile file = two_bones();
  TestNode prop{.name = "Ball"};
  file.nodes.insert(file.nodes.begin(), prop);
  file.nodes[2].parent = 1;
  const File read = read_bytes("made", test::text_of(file));
  EXPECT_EQ(read.motion.skeleton().joint_count(), 2u);
  EXPECT_THAT(texts_of_notices(read.notices),
              testing::ElementsAre("2 trees of bones; the one of 'Arm' with 2 bones is read, without 'Ball'"));
  std::rotate(file.nodes.begin(), file.nodes.begin() + 1, file.nodes.end());
  file.nodes[1].parent = 0;
  EXPECT_TRUE(same_bits(read_bytes("made", test::text_of(file)).motion, read.motion));
}

TEST(FbxRead, NullsAreBonesOnlyWithoutOtherBones) {
  TestFile file = two_bones();
  TestNode marker{.name = "Marker", .type = "Null", .parent = 1};
  file.nodes.push_back(marker);
  EXPECT_EQ(read_bytes("made", test::text_of(file)).motion.skeleton().joint_count(), 2u);
  for (TestNode& node : file.nodes) node.type = "Null";
  const File nulls = read_bytes("made", test::text_of(file));
  EXPECT_EQ(nulls.motion.skeleton().joint_count(), 3u);
  EXPECT_THAT(texts_of_notices(nulls.notices),
              testing::ElementsAre(testing::HasSubstr("Null nodes are used as bones")));
}

TEST(FbxRead, InactivePreRotationIsLeftOutAndReported) {
  TestFile file = two_bones();
  file.nodes[0].properties = TestFile::vector("PreRotation", Vector3d(90, 0, 0));
  const File read = read_bytes("made", test::text_of(file));
  EXPECT_TRUE(read.motion.pose(0).rotations[0].isApprox(Eigen::Quaternionf::Identity()));
  EXPECT_THAT(texts_of_notices(read.notices), testing::ElementsAre(testing::HasSubstr("RotationActive turns off")));
}

TEST(FbxRead, ProgressRisesToOneAndMayCancel) {
  std::vector<double> seen;
  read_bytes("made", test::text_of(two_bones()), {.take = "", .progress = [&](double part) { seen.push_back(part); }});
  ASSERT_FALSE(seen.empty());
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 1.0);
  const auto cancel = [](double) { throw Error(ErrorCode::cancelled, "stopped"); };
  EXPECT_EQ(fbx_fault(test::text_of(two_bones()), {.take = "", .progress = cancel}), "stopped");
}

}  // namespace
}  // namespace signweave::fbx
