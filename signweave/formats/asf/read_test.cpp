#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "signweave/formats/asf/asf.h"
#include "signweave/formats/asf/test_text.h"
#include "signweave/motion/kinematics.h"
#include "signweave/rig/rig_map.h"

namespace signweave::asf {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3f;

const fs::path kGoodFiles = fs::path(SIGNWEAVE_SOURCE_DIR) / "testdata" / "asf";
const ReadOptions kMetres{.unit = 1.0, .rate = FrameRate{100, 1}};

/// Within 0.01 mm.
void expect_same_place(const Vector3f& is, const Vector3f& should) {
  EXPECT_LT((is - should).norm(), 1e-5f) << is.transpose() << " instead of " << should.transpose();
}

/// Within 0.01 degrees.
void expect_turn(const Eigen::Quaternionf& is, double degrees, const Eigen::Vector3d& axis) {
  const Eigen::Quaterniond should(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis));
  EXPECT_LT(is.cast<double>().angularDistance(should) * 180 / std::numbers::pi, 0.01)
      << is.coeffs().transpose() << " instead of " << should.coeffs().transpose();
}

/// The positions of the joints and tips of one frame.
struct Places {
  ModelPose pose;
  const Motion& motion;
  Vector3f operator[](const char* joint) const {
    return pose.positions[static_cast<std::size_t>(motion.skeleton().find(joint).value())];
  }
  Vector3f tip(std::size_t i) const { return position_of(motion.skeleton().tips()[i], pose); }
};
Places places(const Motion& motion, std::int64_t frame) {
  return {to_model_space(motion.skeleton(), motion.pose(frame)), motion};
}

bool has_notice(const std::vector<Notice>& notices, std::string_view part) {
  for (const Notice& notice : notices) {
    if ((notice.where + ": " + notice.text).find(part) != std::string::npos) return true;
  }
  return false;
}

TEST(AsfRead, JointsAreAtTheHeadsOfBonesAndTheLastHaveTips) {
  const File file = read(kGoodFiles / "two.amc", kMetres);
  const Skeleton& skeleton = file.motion.skeleton();
  ASSERT_EQ(skeleton.joint_count(), 3u);
  EXPECT_EQ(skeleton.joint(0).name, "root");
  EXPECT_EQ(skeleton.joint(1).name, "upper");
  EXPECT_EQ(skeleton.joint(2).name, "lower");
  EXPECT_EQ(skeleton.joint(2).parent, 1);
  expect_same_place(skeleton.joint(1).offset, {0, 0, 0});
  expect_same_place(skeleton.joint(2).offset, {0, 2, 0});
  ASSERT_EQ(skeleton.tips().size(), 1u);
  EXPECT_EQ(skeleton.tips()[0].joint, 2);
  expect_same_place(skeleton.tips()[0].offset, {3, 0, 0});
  EXPECT_EQ(file.skeleton, kGoodFiles / "two.asf");
  EXPECT_EQ(file.motion.rate(), (FrameRate{100, 1}));
  EXPECT_EQ(file.notices, std::vector<Notice>{});
  EXPECT_TRUE(keeps_hemisphere(file.motion));
}

// lower's x axis is the figure's y, because its x is turned by 90 about z. Turning by 90 degrees about it takes x to
// -z.
TEST(AsfRead, ABoneTurnsAboutItsOwnAxes) {
  const Motion motion = read(kGoodFiles / "two.amc", kMetres).motion;
  ASSERT_EQ(motion.frame_count(), 2);
  expect_turn(motion.pose(0).rotations[2], 90, Eigen::Vector3d::UnitY());
  const Places first = places(motion, 0);
  expect_same_place(first["root"], {0, 1, 0});
  expect_same_place(first["lower"], {0, 3, 0});
  expect_same_place(first.tip(0), {0, 3, -3});
  const Places second = places(motion, 1);
  expect_same_place(second["lower"], {-1, 1, 0});
  expect_same_place(second.tip(0), {-1, 4, 0});
}

// The directions of the bone's x and y, computed by hand: each axis is turned by 90 degrees about one fixed axis after
// the other.
TEST(AsfRead, EachOrderOfAnAxisTurnsAboutFixedAxes) {
  struct Case {
    const char* order;
    Eigen::Vector3d x, y;
  };
  const Case cases[] = {{"XYZ", {0, 0, -1}, {0, 1, 0}}, {"xzy", {0, 1, 0}, {1, 0, 0}}, {"YXZ", {-1, 0, 0}, {0, 0, 1}},
                        {"YZX", {0, 1, 0}, {-1, 0, 0}}, {"ZXY", {1, 0, 0}, {0, 0, 1}}, {"ZYX", {0, 0, 1}, {0, -1, 0}}};
  for (const Case& one : cases) {
    SCOPED_TRACE(one.order);
    const std::string asf = one_bone({.axis = std::string("90 90 90 ") + one.order, .dof = "rx ry"});
    const Motion motion =
        read_text("a", asf, "b", "1\nroot 0 0 0\nbone 30 0\n2\nroot 0 0 0\nbone 0 30\n", kMetres).motion;
    expect_turn(motion.pose(0).rotations[1], 30, one.x);
    expect_turn(motion.pose(1).rotations[1], 30, one.y);
  }
}

// 90 about z, then 90 about x: x goes to y and then to z. In the other order x stays, and then goes to y.
TEST(AsfRead, DofsTurnInTheirOrder) {
  const auto tip_of = [](const char* dof) {
    const Motion motion = read_text("a", one_bone({.dof = dof}), "b", "1\nroot 0 0 0\nbone 90 90\n", kMetres).motion;
    return places(motion, 0).tip(0);
  };
  expect_same_place(tip_of("rz rx"), {0, 0, 2});
  expect_same_place(tip_of("rx rz"), {0, 2, 0});
}

TEST(AsfRead, TheRootsOrderIsThatOfColumnsAndOfTurns) {
  const std::string asf = one_bone({.order = "RZ TY RX TX TZ", .dof = ""});
  const Motion motion = read_text("a", asf, "b", "1\nroot 90 5 90 3 -1\n", kMetres).motion;
  const Places at = places(motion, 0);
  expect_same_place(at["root"], {3, 5, -1});
  expect_same_place(at.tip(0), {3, 5, 1});
  expect_turn(motion.pose(0).rotations[1], 0, Eigen::Vector3d::UnitX());
}

// The orientation takes x to -z, which 90 about x then takes to y; position and translation are added.
TEST(AsfRead, APresetRootIsAppliedBeforeEachFrame) {
  const std::string asf =
      one_bone({.order = "TX TY TZ RX", .root = "position 10 20 30\norientation 0 90 0", .dof = ""});
  const File file = read_text("a", asf, "b", "1\nroot 1 2 3 90\n", kMetres);
  const Places at = places(file.motion, 0);
  expect_same_place(at["root"], {11, 22, 33});
  expect_same_place(at.tip(0), {11, 24, 33});
  EXPECT_TRUE(has_notice(file.notices, "pre-set"));
}

TEST(AsfRead, ARootWithoutTranslationsIsAtItsPosition) {
  const std::string asf = one_bone({.order = "RX", .root = "position 1 2 3", .dof = "rx"});
  const File file = read_text("a", asf, "b", "1\nroot 0\nbone 0\n", kMetres);
  EXPECT_EQ(file.motion.skeleton().translation_count(), 0u);
  expect_same_place(places(file.motion, 0)["root"], {1, 2, 3});
}

TEST(AsfRead, RadiansOfTheSkeletonHoldForTheMotionUnlessItSaysDegrees) {
  const std::string asf = one_bone({.angle = "rad", .axis = "0 0 1.5707963267948966 XYZ", .dof = "rx"});
  const char* const half_turn = "1\nroot 0 0 0\nbone 3.141592653589793\n";
  expect_turn(read_text("a", asf, "b", half_turn, kMetres).motion.pose(0).rotations[1], 180, Eigen::Vector3d::UnitY());
  const std::string degrees = ":fully-specified\n:Degrees\n1\nroot 0 0 0\nbone 45\n";
  expect_turn(read_text("a", asf, "b", degrees, kMetres).motion.pose(0).rotations[1], 45, Eigen::Vector3d::UnitY());
  const std::string radians = std::string(":RADIANS\n") + half_turn;
  const std::string asf_degrees = one_bone({.axis = "0 0 90 XYZ", .dof = "rx"});
  expect_turn(read_text("a", asf_degrees, "b", radians, kMetres).motion.pose(0).rotations[1], 180,
              Eigen::Vector3d::UnitY());
}

// The bone is turned by 90 about z, so its x is y; its position at rest is the tail of the previous bone, (2, 0, 0).
TEST(AsfRead, TranslationDofsMoveABoneAlongItsOwnAxes) {
  const std::string asf = two_bones("0 0 90 XYZ", "tx tz rx");
  const Motion motion = read_text("a", asf, "b", "1\nroot 0 0 0\nbone 0\nlast 5 7 0\n", kMetres).motion;
  EXPECT_TRUE(motion.skeleton().joint(2).translated);
  expect_same_place(places(motion, 0)["last"], {2, 5, 7});
  expect_same_place(motion.skeleton().joint(2).offset, {2, 0, 0});
}

TEST(AsfRead, ALengthDofIsAddedToTheBoneBeforeItsChildren) {
  const std::string asf = two_bones("0 0 0 XYZ", "rx", "rz l");
  const File file =
      read_text("a", asf, "b", "1\nroot 0 0 0\nbone 90 0.5\nlast 0\n2\nroot 0 0 0\nlast 0\nbone 0 0\n", kMetres);
  expect_same_place(places(file.motion, 0)["last"], {0, 2.5f, 0});
  expect_same_place(places(file.motion, 1)["last"], {2, 0, 0});
  EXPECT_TRUE(has_notice(file.notices, "dof l is read as an addition"));
  EXPECT_FALSE(has_notice(file.notices, "has no children"));
  const File end = read_text("a", one_bone({.dof = "l"}), "b", "1\nroot 0 0 0\nbone 9\n", kMetres);
  EXPECT_TRUE(has_notice(end.notices, "'bone' has no children, so its l moves only its tip"));
}

TEST(AsfRead, LengthsAreDividedByTheUnitThenConvertedToMetres) {
  const std::string asf = one_bone({.length_unit = "0.5", .dof = ""});
  const Motion motion = read_text("a", asf, "b", "1\nroot 3 0 1\n", {.unit = 0.0254}).motion;
  expect_same_place(places(motion, 0)["root"], {6 * 0.0254f, 0, 2 * 0.0254f});
  expect_same_place(motion.skeleton().tips()[0].offset, {4 * 0.0254f, 0, 0});
}

TEST(AsfRead, ZUpIsTurnedToYUp) {
  const std::string asf = one_bone({.dof = "rz"});
  const Motion motion =
      read_text("a", asf, "b", "1\nroot 1 2 3\nbone 90\n", {.unit = 1.0, .up = bvh::UpAxis::z}).motion;
  expect_same_place(places(motion, 0)["root"], {1, 3, -2});
  expect_same_place(places(motion, 0).tip(0), {1, 3, -4});
  expect_turn(motion.pose(0).rotations[1], 90, Eigen::Vector3d::UnitY());
}

TEST(AsfRead, TheRateIs120UnlessGivenAndIsReported) {
  const File file = read(kGoodFiles / "two.amc", {.unit = 1.0});
  EXPECT_EQ(file.motion.rate(), (FrameRate{120, 1}));
  EXPECT_TRUE(has_notice(file.notices, "two.amc: the format does not give the frame rate; 120 frames a second taken"));
}

TEST(AsfRead, SpellingVariantsAreEquivalent) {
  const std::string asf = one_bone({.dof = "RX, RY"});
  std::string crlf;
  for (const char c : asf) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const std::string amc =
      "\xEF\xBB\xBF# a comment\r\n:FULLY-SPECIFIED # another\r\n:degrees\r\n\r\n 7\r\n bone +4.5e1 1e-999 \r\nROOT "
      "1E0,2 3e-0#\r\n8\r\nroot 0 0 0\r\nbone 0 0";
  const File file = read_text("a", crlf, "b", amc, kMetres);
  ASSERT_EQ(file.motion.frame_count(), 2);
  expect_same_place(places(file.motion, 0)["root"], {1, 2, 3});
  expect_turn(file.motion.pose(0).rotations[1], 45, Eigen::Vector3d::UnitX());
  EXPECT_TRUE(has_notice(file.notices, "b:5: the first frame has the number 7; it becomes frame 0"));
}

TEST(AsfRead, AnglesKeepTheirPrecisionThroughManyTurns) {
  const Motion motion = read_text("a", one_bone({.dof = "rx"}), "b", "1\nroot 0 0 0\nbone 360000045\n", kMetres).motion;
  expect_turn(motion.pose(0).rotations[1], 45, Eigen::Vector3d::UnitX());
}

TEST(AsfRead, ValuesOutsideTheLimitsArePreservedAndReportedOnce) {
  const std::string asf = one_bone({.dof = "rx rz\nlimits (-20 30)\n(-inf 10)"});
  const char* const amc = "1\nroot 0 0 0\nbone 40 10\n2\nroot 0 0 0\nbone 30 10.5\n3\nroot 0 0 0\nbone -20 -400\n";
  const File file = read_text("a", asf, "b", amc, kMetres);
  ASSERT_EQ(file.notices.size(), 1u);
  EXPECT_EQ(file.notices[0].where, "b:3");
  EXPECT_EQ(file.notices[0].text,
            "2 numbers are outside of the skeleton's limits and are kept as they are; the first: rx of 'bone' is 40, "
            "its limits are -20 and 30");
  expect_turn(read_text("a", asf, "b", "1\nroot 0 0 0\nbone 40 0\n", kMetres).motion.pose(0).rotations[1], 40,
              Eigen::Vector3d::UnitX());
  // Limits are in the skeleton's unit, here degrees: 0.5236 is just inside 30 degrees, 0.5237 is not.
  EXPECT_TRUE(read_text("a", asf, "b", ":radians\n1\nroot 0 0 0\nbone 0.52359 0\n", kMetres).notices.empty());
  EXPECT_EQ(read_text("a", asf, "b", ":radians\n1\nroot 0 0 0\nbone 0.5237 0\n", kMetres).notices.size(), 1u);
}

TEST(AsfRead, UnknownPartsOfASkeletonAreIgnoredAndReported) {
  std::string asf = one_bone({.dof = "rx"});
  asf.insert(asf.find(":root"), ":skin\nmesh.obj\n:rubbish\n");
  asf.replace(asf.find("direction 1 0 0"), 15, "direction 2 0 0\nbodymass 4\ncolour red");
  asf.replace(asf.find("dof rx"), 6, "dof rx\nlimits (0 1) (2 3)");
  const File file = read_text("a", asf, "b", ":odd\n1\nroot 0 0 0\nbone 5\n", kMetres);
  EXPECT_TRUE(has_notice(file.notices, "':skin' is not part of a skeleton and was ignored"));
  EXPECT_FALSE(has_notice(file.notices, "colour"));
  EXPECT_TRUE(has_notice(file.notices, "bone 'bone' has 2 limits for 1 dofs; its limits are ignored"));
  EXPECT_TRUE(has_notice(file.notices, "the direction of bone 'bone' has the length 2 instead of 1"));
  EXPECT_TRUE(has_notice(file.notices, "b:1: ':odd' is unknown"));
}

TEST(AsfRead, ProgressEndsAtOneAndMayCancel) {
  std::vector<double> reported;
  ReadOptions options = kMetres;
  options.progress = [&](double fraction) { reported.push_back(fraction); };
  std::string amc;
  for (int frame = 1; frame <= 60'000; ++frame) amc += std::to_string(frame) + "\nroot 0 0 0\nbone 0.123456789\n";
  read_text("a", one_bone({.dof = "rx"}), "b", amc, options);
  EXPECT_GE(reported.size(), 2u);
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  EXPECT_EQ(reported.back(), 1.0);
  options.progress = [](double) { throw Error(ErrorCode::cancelled, "enough"); };
  EXPECT_THROW(read_text("a", one_bone({.dof = "rx"}), "b", amc, options), Error);
}

TEST(AsfRead, SeveralRecordingsShareASkeleton) {
  const File one = read(kGoodFiles / "07_01.amc");
  const File two = read(kGoodFiles / "07_02.amc");
  EXPECT_EQ(one.skeleton, kGoodFiles / "07.asf");
  EXPECT_EQ(two.skeleton, kGoodFiles / "07.asf");
  EXPECT_EQ(difference(one.motion.skeleton(), two.motion.skeleton()), std::nullopt);
  EXPECT_FALSE(same_bits(one.motion, two.motion));
}

TEST(AsfRead, TheUnitOfCmuIsGuessedFromTheStature) {
  const File file = read(kGoodFiles / "07_01.amc");
  EXPECT_TRUE(has_notice(file.notices, "07.asf: unit inch (stature 1.")) << file.notices[0].text;
  EXPECT_TRUE(has_notice(file.notices, "guessed for lengths divided by the 0.45 of :units"));
  const Places at = places(file.motion, 0);
  EXPECT_NEAR(at["root"].y(), 0.97, 1e-4);
  EXPECT_NEAR((at["lradius"] - at["lhumerus"]).norm(), 0.28, 1e-4);
  const Motion given = read(kGoodFiles / "07_01.amc", {.unit = 0.0254}).motion;
  EXPECT_TRUE(same_bits(given, file.motion));
}

TEST(AsfRead, TheNamesOfCmuAreMappedToABody) {
  const Motion motion = read(kGoodFiles / "07_01.amc").motion;
  const RigMap map = map_rig(motion);
  EXPECT_EQ(map.convention, "CMU");
  EXPECT_FALSE(map.sides_swapped);
  const auto joint_of = [&](Part part) {
    return map.has(part) ? motion.skeleton().joint(map[part].joint).name : std::string("nothing");
  };
  using enum Part;
  EXPECT_EQ(joint_of(pelvis), "root");
  EXPECT_EQ(joint_of(spine), "lowerback");
  EXPECT_EQ(joint_of(chest), "thorax");
  EXPECT_EQ(joint_of(neck), "lowerneck");
  EXPECT_EQ(joint_of(head), "head");
  EXPECT_EQ(joint_of(left_clavicle), "lclavicle");
  EXPECT_EQ(joint_of(right_clavicle), "rclavicle");
  EXPECT_EQ(joint_of(left_upper_arm), "lhumerus");
  EXPECT_EQ(joint_of(right_upper_arm), "rhumerus");
  EXPECT_EQ(joint_of(left_forearm), "lradius");
  EXPECT_EQ(joint_of(right_forearm), "rradius");
  EXPECT_EQ(joint_of(left_hand), "lwrist");
  EXPECT_EQ(joint_of(right_hand), "rwrist");
  EXPECT_EQ(joint_of(left_thigh), "lfemur");
  EXPECT_EQ(joint_of(right_shin), "rtibia");
  EXPECT_EQ(joint_of(left_foot), "lfoot");
  EXPECT_EQ(joint_of(right_toes), "rtoes");
}

}  // namespace
}  // namespace signweave::asf
