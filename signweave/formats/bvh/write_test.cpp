#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "signweave/core/atomic_file.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/formats/bvh/test_text.h"

namespace signweave::bvh {
namespace {

using testing::HasSubstr;

constexpr std::string_view kTidy = R"(HIERARCHY
ROOT Hips
{
	OFFSET 0.1 0.9 -0.25
	CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
	JOINT left hand
	{
		OFFSET 12.9947 0 -3.5
		CHANNELS 1 Yrotation
		End Site
		{
			OFFSET 0 1.5 0
		}
	}
	JOINT right hand
	{
		OFFSET -12.9947 0 -3.5
		CHANNELS 2 Zrotation Xposition
	}
}
MOTION
Frames: 2
Frame Time: 0.008333
-6.2023 87.7332 -161.6986 17 6.5 5.25 10 45 8.125
-6.25 88 -161.5 17.5 7 5 370 46 8.25
)";

TEST(BvhWrite, ATidyFileIsReproducedCharacterByCharacter) {
  for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
    for (const bool mirror : {false, true}) {
      for (const double unit : {1.0, 0.01, 0.001, 0.0254, 0.0564}) {
        const File file = read_text("f", kTidy, {.up = up, .unit = unit, .root_unit = 2 * unit, .mirror = mirror});
        std::string written = write_text(file.motion, file.layout);
        // Full turns are the only information that a quaternion loses.
        written.replace(written.find(" 10 46 8.25"), 3, " 370");
        EXPECT_EQ(written, kTidy) << unit;
      }
    }
  }
}

TEST(BvhWrite, APermutedRootIsWrittenAsItWasRead) {
  const std::string text =
      "HIERARCHY\nROOT Hips\n{\n\tOFFSET 0.1 0.9 -0.25\n\tCHANNELS 6 Zposition Yposition Xposition "
      "Zrotation Xrotation Yrotation\n}\nMOTION\nFrames: 2\nFrame Time: 0.01\n"
      "10 20 30 -0.25 0.9 0.1\n11 21 31 -0.25 0.9 0.1\n";
  const File file = read_text(
      "f", text, {.up = UpAxis::y, .unit = 0.01, .root_unit = 1.0, .root_columns = RootColumns::rotation_first});
  EXPECT_EQ(file.motion.pose(0).translations[0], Eigen::Vector3f(0.1f, 0.9f, -0.25f));
  EXPECT_EQ(write_text(file.motion, file.layout), text);
}

TEST(BvhWrite, AnglesContinuePastHalfATurnInsteadOfJumping) {
  std::vector<std::string> frames;
  for (int i = 0; i < 80; ++i) frames.push_back("0 0 0 " + std::to_string(i * 10) + " 0 0");
  const File file = read_plainly(chain({}, frames));
  EXPECT_THAT(write_text(file.motion, file.layout), HasSubstr("\n0 0 0 790 0 0\n"));
}

TEST(BvhWrite, NumbersAreNeverInScientificNotation) {
  const File file = read_plainly(one_joint("CHANNELS 3 Xposition Yposition Zposition", "5.1072e-06 -1e-30 123456789"));
  const std::string text = write_text(file.motion, file.layout);
  EXPECT_THAT(text, HasSubstr("\n0.0000051072 -0.000000000000000000000000000001 123456792\n"));
  EXPECT_EQ(read_plainly(text).motion.pose(0).translations[0], file.motion.pose(0).translations[0]);
}

TEST(BvhWrite, TheFileIsTheText) {
  const auto path = std::filesystem::temp_directory_path() / fmt::format("signweave_{}.bvh", ::getpid());
  const File file = read_plainly(kTidy);
  write(path, file.motion, file.layout);
  EXPECT_EQ(read_file(path), write_text(file.motion, file.layout));
  EXPECT_TRUE(read(path, {.up = UpAxis::y, .unit = 1.0}).layout == file.layout);
  std::filesystem::remove(path);
  EXPECT_THROW(write("/nowhere/at/all.bvh", file.motion, file.layout), Error);
}

TEST(BvhWrite, AMotionOfAnotherRatePrintsItsOwnFrameTime) {
  const File file = read_plainly(kTidy);
  Motion slower(file.motion.shared_skeleton(), FrameRate{30000, 1001}, 1);
  EXPECT_THAT(write_text(slower, file.layout), HasSubstr("Frame Time: 0.033367\n"));
  for (const FrameRate rate : {FrameRate{120, 1}, FrameRate{2997, 125}, FrameRate{100, 3}, FrameRate{1234, 7}}) {
    const Motion other(file.motion.shared_skeleton(), rate, 1);
    const double back = read_plainly(write_text(other, file.layout)).motion.rate().hertz();
    EXPECT_NEAR(back / rate.hertz(), 1.0, 1e-12);
  }
}

TEST(BvhWrite, JointsInAnyOrderAreWrittenDepthFirst) {
  const auto skeleton = std::make_shared<const Skeleton>(std::vector<Joint>{{"root", kNoJoint, {0, 0, 0}, true},
                                                                            {"left", 0, {1, 0, 0}, false},
                                                                            {"right", 0, {2, 0, 0}, false},
                                                                            {"left tip", 1, {3, 0, 0}, true},
                                                                            {"right tip", 2, {4, 0, 0}, false}},
                                                         std::vector<Tip>{{4, {5, 0, 0}}});
  Motion motion(skeleton, FrameRate{100, 1}, 1);
  motion.pose(0).translations[1] = {0, 7, 0};
  motion.pose(0).rotations[2] = Eigen::AngleAxisf(0.5f, Eigen::Vector3f::UnitY());
  const File back = read_text("f", write_text(motion, default_layout(*skeleton)), {.up = UpAxis::y, .unit = 0.01});
  const Skeleton& found = back.motion.skeleton();
  EXPECT_EQ(found.joint(2).name, "left tip");
  EXPECT_EQ(back.motion.pose(0).translations[1], Eigen::Vector3f(0, 7, 0));
  EXPECT_EQ(found.joint(3).name, "right");
  EXPECT_LT(degrees_between(back.motion.pose(0).rotations[3], motion.pose(0).rotations[2]), 1e-4);
  EXPECT_EQ(found.tips()[0].joint, 4);
}

TEST(BvhWrite, ALayoutThatDoesNotFitIsRefused) {
  const File file = read_plainly(kTidy);
  Layout layout = file.layout;
  EXPECT_TRUE(fits(layout, file.motion.skeleton()));
  layout.channels[0] = {Channel::x_rotation};
  EXPECT_FALSE(fits(layout, file.motion.skeleton())) << "the root's translation would be lost";
  EXPECT_THROW(write_text(file.motion, layout), Error);
  layout = file.layout;
  layout.channels.pop_back();
  EXPECT_FALSE(fits(layout, file.motion.skeleton()));
  layout = file.layout;
  layout.channels[1] = {Channel::x_rotation, Channel::x_rotation};
  EXPECT_FALSE(fits(layout, file.motion.skeleton()));
  layout = file.layout;
  layout.unit = 0;
  EXPECT_FALSE(fits(layout, file.motion.skeleton()));
  layout = file.layout;
  layout.channels[0].pop_back();
  layout.root_columns = RootColumns::rotation_first;
  EXPECT_FALSE(fits(layout, file.motion.skeleton()));
}

TEST(BvhWrite, ANameWithALineBreakIsRefused) {
  const auto skeleton = std::make_shared<const Skeleton>(std::vector<Joint>{{"a\nMOTION", kNoJoint, {0, 0, 0}, true}},
                                                         std::vector<Tip>{});
  EXPECT_THROW(write_text(Motion(skeleton, FrameRate{}, 1), default_layout(*skeleton)), Error);
}

TEST(BvhLayout, TheDefaultIsCentimetresYUpZxy) {
  const File file = read_plainly(kTidy);
  const Layout layout = default_layout(file.motion.skeleton());
  EXPECT_TRUE(fits(layout, file.motion.skeleton()));
  EXPECT_EQ(layout.unit, 0.01);
  EXPECT_EQ(layout.up, UpAxis::y);
  EXPECT_EQ(layout.channels[1], (std::vector{Channel::z_rotation, Channel::x_rotation, Channel::y_rotation}));
  EXPECT_EQ(layout.channels[2].size(), 6u);
}

TEST(BvhLayout, IsStoredAndReadBack) {
  const File file = read_text("f", kTidy, {.up = UpAxis::z, .unit = 0.0254, .root_unit = 1.0, .mirror = true});
  ByteWriter out;
  encode(file.layout, out);
  ByteReader in(out.bytes(), "layout");
  EXPECT_EQ(decode_layout(in), file.layout);
  in.finish();
}

TEST(BvhLayout, DamagedBytesAreRefusedWithoutOtherEffects) {
  const File file = read_plainly(kTidy);
  ByteWriter out;
  encode(file.layout, out);
  for (std::size_t size = 0; size < out.size(); ++size) {
    ByteReader in(ByteSpan(out.bytes()).first(size), "layout");
    EXPECT_THROW(decode_layout(in), Error) << size;
  }
  for (std::size_t at = 0; at < out.size(); ++at) {
    Bytes bytes = out.bytes();
    bytes[at] ^= std::byte{0xFF};
    ByteReader in(bytes, "layout");
    try {
      decode_layout(in);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::corrupt);
    }
  }
}

/// A random BVH file: any tree, any subset and order of channels on each joint.
std::string random_text() {
  const int joints = *rc::gen::inRange(1, 9);
  std::vector<std::vector<int>> children(static_cast<std::size_t>(joints));
  for (int i = 1; i < joints; ++i)
    children[*rc::gen::inRange<std::size_t>(0, static_cast<std::size_t>(i))].push_back(i);
  const auto number = [](double most, int steps) {
    return std::to_string(*rc::gen::inRange(-steps, steps + 1) * most / steps);
  };
  const auto offset = [&] {
    return "OFFSET " + number(50, 5000) + ' ' + number(50, 5000) + ' ' + number(50, 5000) + '\n';
  };
  const std::vector<std::string> names = {"Xposition", "Yposition", "Zposition", "Xrotation", "Yrotation", "Zrotation"};
  std::vector<std::string> columns;
  const std::function<std::string(int)> joint = [&](int index) {
    std::vector<std::string> channels;
    for (const std::string& name : names) {
      const std::size_t at = *rc::gen::inRange<std::size_t>(0, channels.size() + 1);
      if (*rc::gen::inRange(0, 3) > 0) channels.insert(channels.begin() + static_cast<std::ptrdiff_t>(at), name);
    }
    if (index == 0 && channels.empty()) channels.push_back("Xrotation");
    std::string text = (index == 0 ? "ROOT joint " : "JOINT joint ") + std::to_string(index) + "\n{\n" + offset();
    text += "CHANNELS " + std::to_string(channels.size());
    for (const std::string& name : channels) text += ' ' + name;
    text += '\n';
    columns.insert(columns.end(), channels.begin(), channels.end());
    if (*rc::gen::arbitrary<bool>()) text += "End Site\n{\n" + offset() + "}\n";
    for (const int child : children[static_cast<std::size_t>(index)]) text += joint(child);
    return text + "}\n";
  };
  std::string text = "HIERARCHY\n" + joint(0);
  const int frames = *rc::gen::inRange(1, 6);
  text += "MOTION\nFrames: " + std::to_string(frames) + "\nFrame Time: 0.0083333\n";
  for (int frame = 0; frame < frames; ++frame) {
    for (const std::string& column : columns) {
      const bool rotation = column[1] == 'r';
      // Sometimes multiples of 45°, for gimbal lock and half turns.
      text += rotation && *rc::gen::inRange(0, 4) == 0 ? std::to_string(45 * *rc::gen::inRange(-8, 9))
                                                       : number(rotation ? 400 : 200, 1'000'000);
      text += ' ';
    }
    text += '\n';
  }
  return text;
}

RC_GTEST_PROP(BvhWrite, WhatIsWrittenIsReadBackTheSame, ()) {
  const std::string text = random_text();
  const ReadOptions options{.up = *rc::gen::element(UpAxis::y, UpAxis::z),
                            .unit = *rc::gen::element(1.0, 0.01, 0.0254),
                            .root_unit = *rc::gen::element(1.0, 0.01),
                            .mirror = *rc::gen::arbitrary<bool>()};
  const File first = read_text("first", text, options);
  const std::string written = write_text(first.motion, first.layout);
  const File second = read_text("second", written, options);
  RC_ASSERT(second.layout == first.layout);
  RC_ASSERT(second.motion.skeleton() == first.motion.skeleton());
  RC_ASSERT(second.motion.rate() == first.motion.rate());
  RC_ASSERT(second.motion.frame_count() == first.motion.frame_count());
  RC_ASSERT(std::ranges::equal(second.motion.translations(), first.motion.translations()));
  for (std::size_t i = 0; i < first.motion.rotations().size(); ++i) {
    RC_ASSERT(degrees_between(first.motion.rotations()[i], second.motion.rotations()[i]) <= 1e-4);
  }
}

RC_GTEST_PROP(BvhWrite, InAnyOrderAxisAndUnitItShowsTheSame, ()) {
  constexpr Channel kXTurn = Channel::x_rotation;
  constexpr Channel kYTurn = Channel::y_rotation;
  constexpr Channel kZTurn = Channel::z_rotation;
  using Order = std::array<Channel, 3>;
  const File first = read_text("first", random_text(), {.unit = 0.01, .mirror = *rc::gen::arbitrary<bool>()});
  const LayoutChanges changes{.order = *rc::gen::element(Order{kXTurn, kYTurn, kZTurn}, Order{kXTurn, kZTurn, kYTurn},
                                                         Order{kYTurn, kXTurn, kZTurn}, Order{kYTurn, kZTurn, kXTurn},
                                                         Order{kZTurn, kXTurn, kYTurn}, Order{kZTurn, kYTurn, kXTurn}),
                              .up = *rc::gen::element(UpAxis::y, UpAxis::z),
                              .unit = *rc::gen::element(1.0, 0.01, 0.0254)};
  const Layout layout = with(first.layout, changes);
  RC_ASSERT(fits(layout, first.motion.skeleton()));
  for (const std::vector<Channel>& channels : layout.channels) {
    RC_ASSERT(std::equal(channels.end() - 3, channels.end(), changes.order->begin()));
  }
  const File second = read_text("second", write_text(first.motion, layout),
                                {.up = layout.up, .unit = layout.unit, .mirror = layout.mirrored});
  RC_ASSERT(second.motion.frame_count() == first.motion.frame_count());
  for (std::size_t i = 0; i < first.motion.rotations().size(); ++i) {
    RC_ASSERT(degrees_between(first.motion.rotations()[i], second.motion.rotations()[i]) <= 1e-4);
  }
  for (std::size_t i = 0; i < first.motion.translations().size(); ++i) {
    RC_ASSERT(second.motion.translations()[i].isApprox(first.motion.translations()[i], 1e-5f));
  }
  for (std::size_t i = 0; i < first.motion.skeleton().joint_count(); ++i) {
    RC_ASSERT(second.motion.skeleton().joints()[i].offset.isApprox(first.motion.skeleton().joints()[i].offset, 1e-5f));
  }
}

}  // namespace
}  // namespace signweave::bvh
