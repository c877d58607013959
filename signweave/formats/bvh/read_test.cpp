#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "signweave/formats/bvh/bvh.h"
#include "signweave/formats/bvh/test_text.h"

namespace signweave::bvh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Eigen::Quaternionf about(float degrees, const Eigen::Vector3f& axis) {
  return Eigen::Quaternionf(Eigen::AngleAxisf(degrees * std::numbers::pi_v<float> / 180, axis));
}
const Eigen::Vector3f kX = Eigen::Vector3f::UnitX();
const Eigen::Vector3f kY = Eigen::Vector3f::UnitY();
const Eigen::Vector3f kZ = Eigen::Vector3f::UnitZ();

std::string fault_in_text(std::string_view text, const ReadOptions& options = {}) {
  try {
    read_text("f.bvh", text, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    return error.what();
  }
  return "no fault";
}

TEST(BvhRead, RotationChannelsAreAppliedInTheirOrder) {
  const File zxy = read_plainly(one_joint("CHANNELS 3 Zrotation Xrotation Yrotation", "10 20 30"));
  EXPECT_LT(degrees_between(zxy.motion.pose(0).rotations[0], about(10, kZ) * about(20, kX) * about(30, kY)), 1e-4);
  const File yzx = read_plainly(one_joint("CHANNELS 3 Yrotation Zrotation Xrotation", "10 20 30"));
  EXPECT_LT(degrees_between(yzx.motion.pose(0).rotations[0], about(10, kY) * about(20, kZ) * about(30, kX)), 1e-4);
  EXPECT_THAT(yzx.layout.channels[0], ElementsAre(Channel::y_rotation, Channel::z_rotation, Channel::x_rotation));
}

TEST(BvhRead, ChannelsMayBeInAnyOrder) {
  const File file = read_plainly(
      one_joint("CHANNELS 6 Yrotation Zposition Xrotation Xposition Zrotation Yposition", "10 3 20 1 30 2"));
  EXPECT_EQ(file.motion.pose(0).translations[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_LT(degrees_between(file.motion.pose(0).rotations[0], about(10, kY) * about(20, kX) * about(30, kZ)), 1e-4);
}

TEST(BvhRead, APositionReplacesTheOffsetAndAMissingOneTakesItsComponent) {
  const File one = read_plainly(one_joint("CHANNELS 2 Yposition Xrotation", "7 90"));
  EXPECT_EQ(one.motion.pose(0).translations[0], Eigen::Vector3f(1, 7, 3));
  EXPECT_LT(degrees_between(one.motion.pose(0).rotations[0], about(90, kX)), 1e-4);
  const File none = read_plainly(one_joint("CHANNELS 1 Xrotation", "90"));
  EXPECT_FALSE(none.motion.skeleton().joint(0).translated);
  EXPECT_EQ(none.motion.skeleton().joint(0).offset, Eigen::Vector3f(1, 2, 3));
}

TEST(BvhRead, AnyJointMayHaveAnyChannelsAndOrdersMayMix) {
  const File file = read_text("f", R"(HIERARCHY
ROOT a
{
  OFFSET 0 0 0
  CHANNELS 0
  JOINT b
  {
    OFFSET 1 0 0
    CHANNELS 6 Xposition Yposition Zposition Xrotation Yrotation Zrotation
    JOINT c
    {
      OFFSET 0 1 0
      CHANNELS 1 Yrotation
    }
  }
  JOINT d
  {
    OFFSET 0 0 1
    CHANNELS 3 Xposition Yposition Zposition
    End Site
    {
      OFFSET 0 0 2
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.01
1 2 3 0 0 90 45 4 5 6
1 2 3 0 0 90 46 7 8 9
)",
                              {.up = UpAxis::y, .unit = 1.0});
  const Skeleton& skeleton = file.motion.skeleton();
  EXPECT_THAT(skeleton.translated_joints(), ElementsAre(1, 3));
  EXPECT_EQ(skeleton.joint(2).parent, 1);
  EXPECT_EQ(skeleton.joint(3).parent, 0);
  ASSERT_EQ(skeleton.tips().size(), 1u);
  EXPECT_EQ(skeleton.tips()[0], (Tip{.joint = 3, .offset = {0, 0, 2}}));
  ASSERT_EQ(file.motion.frame_count(), 2);
  EXPECT_EQ(file.motion.pose(1).translations[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(file.motion.pose(1).translations[1], Eigen::Vector3f(7, 8, 9));
  EXPECT_EQ(file.motion.pose(1).rotations[0].coeffs(), Eigen::Quaternionf::Identity().coeffs());
  EXPECT_LT(degrees_between(file.motion.pose(1).rotations[2], about(46, kY)), 1e-4);
  EXPECT_LT(degrees_between(file.motion.pose(1).rotations[1], about(90, kZ)), 1e-4);
}

TEST(BvhRead, NamesAreTheRestOfTheirLine) {
  const std::vector<std::string> names = {"left upper arm", "mixamorig:Head", "右手", "ÉPAULE.G", "Neck { 1"};
  const std::string zeros = "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0";
  const File file = read_plainly(chain(names, {zeros}));
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(file.motion.skeleton().joints()[i + 1].name, names[i]);
}

TEST(BvhRead, ABraceMayBeOnTheLineOfTheName) {
  const File file = read_plainly(
      "HIERARCHY\nROOT My Hips {\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\nEnd Site {\nOFFSET 0 1 0\n}\nJOINT odd{\n{\n"
      "OFFSET 0 0 0\nCHANNELS 0\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.01\n5\n");
  EXPECT_EQ(file.motion.skeleton().joint(0).name, "My Hips");
  EXPECT_EQ(file.motion.skeleton().joint(1).name, "odd{");
  EXPECT_EQ(file.motion.skeleton().tips().size(), 1u);
}

TEST(BvhRead, LineEndsTabsAndKeywordCaseDoNotMatter) {
  const std::string text = chain({"Spine"}, {"1 2 3 4 5 6 7 8 9", "1 2 3 4 5 6 7 8 10"}, "0.008333");
  const auto replaced = [&](std::string_view from, std::string_view to, std::string result) {
    for (std::size_t at = result.find(from); at != std::string::npos; at = result.find(from, at + to.size())) {
      result.replace(at, from.size(), to);
    }
    return result;
  };
  const File plain = read_plainly(text);
  std::string shouted = text;
  for (const char* const word : {"ROOT", "JOINT", "OFFSET", "CHANNELS", "End Site", "MOTION", "Frames", "Frame Time",
                                 "HIERARCHY", "Xposition", "Zrotation"}) {
    std::string other;
    for (const char c : std::string_view(word)) {
      other += static_cast<char>(std::islower(static_cast<unsigned char>(c)) != 0
                                     ? std::toupper(static_cast<unsigned char>(c))
                                     : std::tolower(static_cast<unsigned char>(c)));
    }
    shouted = replaced(word, other, shouted);
  }
  for (const std::string& variant :
       {replaced("\n", "\r\n", text), replaced("\n", "\r", text), replaced(" ", "\t", text), "\xEF\xBB\xBF" + text,
        shouted, replaced("Frames: ", "Frames:\t", text), replaced("Frames: ", "Frames:", text), text + "\n \n\t\n",
        replaced("Frame Time: ", "Frame Time:\t", text), text.substr(0, text.size() - 1)}) {
    const File file = read_plainly(variant);
    EXPECT_EQ(file.layout, plain.layout) << variant;
    EXPECT_TRUE(file.motion.skeleton() == plain.motion.skeleton()) << variant;
    EXPECT_EQ(file.motion.frame_count(), 2);
    EXPECT_EQ(file.motion.pose(1).rotations[1].coeffs(), plain.motion.pose(1).rotations[1].coeffs());
  }
}

TEST(BvhRead, ScientificNotationIsRead) {
  const File file = read_plainly(one_joint("CHANNELS 2 Xposition Yposition", "5.5e-03 -1.25E2"));
  EXPECT_EQ(file.motion.pose(0).translations[0], Eigen::Vector3f(0.0055f, -125, 3));
}

TEST(BvhRead, TheFrameTimeIsKeptAsTextAndSnappedWithANotice) {
  const File file = read_plainly(chain({}, {"0 0 0 0 0 0"}, "0.008333"));
  EXPECT_EQ(file.layout.frame_time, "0.008333");
  EXPECT_EQ(file.motion.rate(), (FrameRate{120, 1}));
  EXPECT_THAT(file.notices, ElementsAre(Notice{"f.bvh:13", "frame time 0.008333 taken as 120 frames a second"}));
  EXPECT_THAT(read_plainly(chain({}, {"0 0 0 0 0 0"}, "0.01")).notices, IsEmpty());
}

TEST(BvhRead, NeighbouringQuaternionsKeepOneHemisphere) {
  std::vector<std::string> frames;
  for (int i = 0; i < 100; ++i) frames.push_back("0 0 0 " + std::to_string(i * 10 % 360) + " 0 0");
  const File file = read_plainly(chain({}, frames));
  for (std::int64_t i = 1; i < 100; ++i) {
    EXPECT_GT(file.motion.pose(i).rotations[0].dot(file.motion.pose(i - 1).rotations[0]), 0);
  }
}

TEST(BvhRead, ZUpTurnsEveryJointByOneChangeOfBasis) {
  const std::string text = chain({"Spine"}, {"1 2 3 10 20 30 40 50 60"});
  const File y = read_text("f", text, {.up = UpAxis::y, .unit = 1.0});
  const File z = read_text("f", text, {.up = UpAxis::z, .unit = 0.01});
  const Eigen::Quaternionf basis = about(-90, kX);
  EXPECT_TRUE(z.motion.pose(0).translations[0].isApprox(Eigen::Vector3f(0.01f, 0.03f, -0.02f)));
  for (std::size_t joint = 0; joint < 2; ++joint) {
    const Eigen::Quaternionf expected = basis * y.motion.pose(0).rotations[joint] * basis.conjugate();
    EXPECT_LT(degrees_between(z.motion.pose(0).rotations[joint], expected), 1e-4);
    EXPECT_TRUE(z.motion.skeleton().joints()[joint].offset.isApprox(
        0.01f * (basis * y.motion.skeleton().joints()[joint].offset), 1e-5f));
  }
  EXPECT_TRUE(z.motion.skeleton().tips()[0].offset.isApprox(Eigen::Vector3f(0, 0, -0.05f)));
}

TEST(BvhRead, AMirrorReflectsXInPositionsAndRotations) {
  const std::string text = chain({"Spine"}, {"1 2 3 10 20 30 40 50 60"});
  for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
    const File plain = read_text("f", text, {.up = up, .unit = 1.0});
    const File mirrored = read_text("f", text, {.up = up, .unit = 1.0, .mirror = true});
    const Eigen::Matrix3f reflect = Eigen::Vector3f(-1, 1, 1).asDiagonal();
    EXPECT_EQ(mirrored.motion.pose(0).translations[0], reflect * plain.motion.pose(0).translations[0]);
    for (std::size_t joint = 0; joint < 2; ++joint) {
      const Eigen::Matrix3f expected = reflect * plain.motion.pose(0).rotations[joint].toRotationMatrix() * reflect;
      EXPECT_TRUE(mirrored.motion.pose(0).rotations[joint].toRotationMatrix().isApprox(expected, 1e-6f));
    }
  }
}

TEST(BvhRead, TheRootMayHaveAUnitOfItsOwn) {
  const File file =
      read_text("f", chain({"Spine"}, {"1 2 3 0 0 0 0 0 0"}), {.up = UpAxis::y, .unit = 0.01, .root_unit = 1.0});
  EXPECT_EQ(file.motion.pose(0).translations[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(file.motion.skeleton().joint(1).offset, Eigen::Vector3f(0, 0.1f, 0));
  EXPECT_EQ(file.layout.root_unit, 1.0);
}

constexpr std::string_view kPermuted =
    "HIERARCHY\nROOT Hips\n{\nOFFSET 0.1 0.9 -0.25\nCHANNELS 6 Xposition Yposition Zposition "
    "Zrotation Xrotation Yrotation\n}\nMOTION\nFrames: 2\nFrame Time: 0.01\n"
    "10 20 30 0.1 0.9 -0.25\n11 21 31 0.1 0.9 -0.25\n";

TEST(BvhRead, APermutedRootIsReportedAndReadAsDeclared) {
  const File file = read_plainly(kPermuted);
  ASSERT_EQ(file.notices.size(), 1u);
  EXPECT_THAT(file.notices[0].text, HasSubstr("look permuted"));
  EXPECT_EQ(file.notices[0].remedies, (Remedies{{"root_order", "rotation_first"}, {"root_unit", "m"}}));
  EXPECT_EQ(file.motion.pose(0).translations[0], Eigen::Vector3f(10, 20, 30));
  EXPECT_EQ(file.layout.root_columns, RootColumns::declared);
}

TEST(BvhRead, APermutedRootIsFixedOnRequest) {
  const File file = read_text(
      "f", kPermuted, {.up = UpAxis::y, .unit = 0.01, .root_unit = 1.0, .root_columns = RootColumns::rotation_first});
  EXPECT_THAT(file.notices, IsEmpty());
  EXPECT_EQ(file.motion.pose(0).translations[0], Eigen::Vector3f(0.1f, 0.9f, -0.25f));
  EXPECT_LT(degrees_between(file.motion.pose(0).rotations[0], about(10, kZ) * about(20, kX) * about(30, kY)), 1e-4);
}

TEST(BvhRead, ARootThatOnlySometimesHoldsItsOffsetIsNotCalledPermuted) {
  std::string text(kPermuted);
  text.replace(text.rfind("-0.25"), 5, "-0.35");
  EXPECT_THAT(read_plainly(text).notices, IsEmpty());
  EXPECT_THAT(read_plainly(chain({}, {"1 2 3 0 0 0", "4 5 6 0 0 0"})).notices, IsEmpty()) << "all zero is a rest pose";
}

TEST(BvhRead, RotationFirstNeedsARootThatCanBePermuted) {
  EXPECT_THAT(fault_in_text(one_joint("CHANNELS 3 Zrotation Xrotation Yrotation", "1 2 3"),
                            {.root_columns = RootColumns::rotation_first}),
              HasSubstr("only if CHANNELS names three positions"));
}

TEST(BvhRead, FramesThatDoNotMatchLinesAreReported) {
  const File file = read_plainly(chain({}, {"1 2 3 4 5 6", "1 2 3\n4 5 6", "1 2 3 4 5 6"}));
  EXPECT_EQ(file.motion.frame_count(), 3);
  ASSERT_EQ(file.notices.size(), 1u);
  EXPECT_EQ(file.notices[0].where, "f.bvh:15");
}

TEST(BvhRead, ANameThatIsNotUtf8IsPreservedAndReported) {
  const File file = read_plainly(chain({"\xE9paule"}, {"1 2 3 4 5 6 7 8 9"}));
  EXPECT_EQ(file.motion.skeleton().joint(1).name, "\xE9paule");
  ASSERT_EQ(file.notices.size(), 1u);
  EXPECT_THAT(file.notices[0].text, HasSubstr("UTF-8"));
}

TEST(BvhRead, DeepNestingDoesNotUseTheCallStack) {
  std::string deep = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n";
  const auto nest = [](std::string text, int levels) {
    for (int i = 0; i < levels; ++i) text += "JOINT a\n{\nOFFSET 0 0 0\n";
    for (int i = 0; i <= levels; ++i) text += "}\n";
    return text + "MOTION\nFrames: 1\nFrame Time: 0.01\n90\n";
  };
  const File file = read_plainly(nest(deep, 65'534));
  EXPECT_EQ(file.motion.skeleton().joint_count(), 65'535u);
  const std::string written = write_text(file.motion, file.layout);
  EXPECT_LT(written.size(), 20'000'000u);
  EXPECT_TRUE(read_plainly(written).motion.skeleton() == file.motion.skeleton());
  EXPECT_THAT(fault_in_text(nest(deep, 100'000)), HasSubstr("more than 65535 joints"));
}

TEST(BvhRead, AHugeCountOfFramesAllocatesNothing) {
  std::string text = chain({}, {"1 2 3 4 5 6"});
  text.replace(text.find("Frames: 1"), 9, "Frames: 9223372036854775807");
  EXPECT_THAT(fault_in_text(text),
              HasSubstr("the file ends after 1 whole frames, but Frames: says 9223372036854775807"));
}

TEST(BvhRead, AFewNumbersDoNotExpandToGigabytesOfJointsAtRest) {
  std::string text = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n";
  for (int i = 0; i < 5'000; ++i) text += "JOINT a\n{\nOFFSET 0 0 0\n}\n";
  text += "}\nMOTION\nFrames: 1000000\nFrame Time: 0.01\n";
  for (int i = 0; i < 1'000'000; ++i) text += "0\n";
  EXPECT_THAT(fault_in_text(text), HasSubstr("leave out the joints that do not move"));
}

TEST(BvhRead, AUnitMustBeALength) {
  for (const double unit : {0.0, -1.0, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT(fault_in_text(kPermuted, {.unit = unit}), HasSubstr("unit"));
    EXPECT_THAT(fault_in_text(kPermuted, {.root_unit = unit}), HasSubstr("unit"));
  }
}

TEST(BvhRead, ProgressRisesToOneAndMayCancel) {
  std::vector<std::string> rows(60'000, "100.000001 200.000001 300.000001 10.000001 20.000001 30.000001");
  const std::string text = chain({}, rows);
  std::vector<double> seen;
  read_text("f", text, {.up = UpAxis::y, .unit = 1.0, .progress = [&](double fraction) { seen.push_back(fraction); }});
  EXPECT_GE(seen.size(), 3u);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 1.0);
  const auto stop = [](double) { throw Error(ErrorCode::cancelled, "stopped"); };
  EXPECT_THROW(read_text("f", text, {.progress = stop}), Error);
}

TEST(BvhRead, AMissingFileIsNotFound) {
  try {
    read("/nowhere/at/all.bvh");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_found);
  }
}

}  // namespace
}  // namespace signweave::bvh
