#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "signweave/formats/bvh/bvh.h"
#include "signweave/formats/bvh/test_text.h"

namespace signweave::bvh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// One bone of a body of 1.7 m, listed depth first.
struct Bone {
  std::string name;
  int depth;
  Eigen::Vector3d offset;  ///< metres, Y up, x to the left
};

const std::vector<Bone> kBody = {{"Hips", 0, {0, 0, 0}},
                                 {"Spine", 1, {0, 0.25, 0}},
                                 {"Neck", 2, {0, 0.3, 0}},
                                 {"Head", 3, {0, 0.1, 0}},
                                 {"LeftArm", 2, {0.2, 0.2, 0}},
                                 {"LeftHand", 3, {0.5, 0, 0}},
                                 {"RightArm", 2, {-0.2, 0.2, 0}},
                                 {"RightHand", 3, {-0.5, 0, 0}},
                                 {"LeftUpLeg", 1, {0.1, -0.05, 0}},
                                 {"LeftLeg", 2, {0, -0.4, 0}},
                                 {"LeftFoot", 3, {0, -0.4, 0}},
                                 {"LeftToe", 4, {0, -0.05, 0.12}},
                                 {"RightUpLeg", 1, {-0.1, -0.05, 0}},
                                 {"RightLeg", 2, {0, -0.4, 0}},
                                 {"RightFoot", 3, {0, -0.4, 0}},
                                 {"RightToe", 4, {0, -0.05, 0.12}}};

struct Style {
  double unit = 0.01;  ///< metres
  UpAxis up = UpAxis::y;
  bool nameless = false;           ///< joints are named j0, j1, …
  bool offsets_in_frames = false;  ///< six channels everywhere and meaningless OFFSETs
  std::string root_rotation = "0 0 0";
};

Eigen::Vector3d in_file(const Eigen::Vector3d& v, const Style& style) {
  const Eigen::Vector3d turned = style.up == UpAxis::z ? Eigen::Vector3d(v.x(), -v.z(), v.y()) : v;
  return turned / style.unit;
}

std::string body_text(const Style& style) {
  std::string text = "HIERARCHY\n";
  std::string frame;
  int open = 0;
  for (std::size_t i = 0; i < kBody.size(); ++i) {
    const Bone& bone = kBody[i];
    for (; open > bone.depth; --open) text += "}\n";
    text += fmt::format("{} {}\n{{\n", i == 0 ? "ROOT" : "JOINT", style.nameless ? fmt::format("j{}", i) : bone.name);
    ++open;
    const Eigen::Vector3d offset = in_file(bone.offset, style);
    const std::string numbers = fmt::format("{:.6f} {:.6f} {:.6f}", offset.x(), offset.y(), offset.z());
    text += "OFFSET " + (style.offsets_in_frames ? std::string("9 9 9") : numbers) + "\n";
    const bool moves = i == 0 || style.offsets_in_frames;
    text += moves ? "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
                  : "CHANNELS 3 Zrotation Xrotation Yrotation\n";
    if (bone.name == "Head") text += "End Site\n{\nOFFSET 0 0 0\n}\n";
    if (moves) frame += numbers + ' ';
    frame += (i == 0 ? style.root_rotation : "0 0 0") + ' ';
  }
  for (; open > 0; --open) text += "}\n";
  return text + "MOTION\nFrames: 2\nFrame Time: 0.01\n" + frame + '\n' + frame + '\n';
}

std::vector<std::string> notices_of(const File& file) {
  std::vector<std::string> texts;
  for (const Notice& notice : file.notices) texts.push_back(notice.text);
  return texts;
}

/// The height of the head above the left foot in the first frame, in metres.
float height_of(const File& file) {
  float height = 0;
  for (JointIndex joint = *file.motion.skeleton().find("Head"); joint > 0;) {
    height += file.motion.skeleton().joint(joint).offset.y();
    joint = file.motion.skeleton().joint(joint).parent;
  }
  return height;
}

TEST(BvhGuess, TheUnitIsTheOneThatGivesAHumanBody) {
  for (const double unit : {1.0, 0.01, 0.001, 0.0254, 0.0564}) {
    for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
      const File file = read_text("f", body_text({.unit = unit, .up = up}));
      EXPECT_EQ(file.layout.unit, unit);
      EXPECT_EQ(file.layout.root_unit, unit);
      EXPECT_EQ(file.layout.up, up);
      EXPECT_NEAR(height_of(file), 0.65, 1e-5);
    }
  }
}

TEST(BvhGuess, EveryGuessIsReported) {
  EXPECT_THAT(notices_of(read_text("f", body_text({}))), ElementsAre("up axis y and unit cm (stature 1.56 m) guessed"));
  EXPECT_THAT(notices_of(read_text("f", body_text({.unit = 0.0564, .up = UpAxis::z}))),
              ElementsAre("up axis z and unit 0.0564 m (stature 1.56 m) guessed"));
  EXPECT_THAT(notices_of(read_text("f", body_text({}), {.up = UpAxis::y})),
              ElementsAre("unit cm (stature 1.56 m) guessed"));
  EXPECT_THAT(notices_of(read_text("f", body_text({}), {.unit = 0.01})), ElementsAre("up axis y guessed"));
}

TEST(BvhGuess, GivenOptionsAreUsedWithoutANotice) {
  const File file = read_text("f", body_text({}), {.up = UpAxis::z, .unit = 1.0});
  EXPECT_THAT(file.notices, IsEmpty());
  EXPECT_EQ(file.layout.up, UpAxis::z);
  EXPECT_EQ(file.layout.unit, 1.0);
}

TEST(BvhGuess, UpIsTakenFromPosedFramesAndNotFromTheRestPose) {
  // The skeleton rests Z up and the root turns it Y up in every frame (about X by −90°).
  const File file = read_text("f", body_text({.up = UpAxis::z, .root_rotation = "0 -90 0"}));
  EXPECT_EQ(file.layout.up, UpAxis::y);
}

TEST(BvhGuess, BonesGivenOnlyByPositionChannelsAreMeasuredInTheFrames) {
  const File file = read_text("f", body_text({.unit = 0.001, .offsets_in_frames = true}));
  EXPECT_EQ(file.layout.unit, 0.001);
}

TEST(BvhGuess, WithoutNamesTheExtentOfTheBodyDecides) {
  for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
    const File file = read_text("f", body_text({.unit = 0.0254, .up = up, .nameless = true}));
    EXPECT_EQ(file.layout.up, up);
    EXPECT_EQ(file.layout.unit, 0.0254);
    ASSERT_EQ(file.notices.size(), 1u);
    EXPECT_THAT(file.notices[0].text, HasSubstr("inch (no head and feet by name; extent 1.55 m)"));
  }
}

TEST(BvhGuess, ANonHumanBodyIsReadInCentimetresWithAWarning) {
  const File file = read_text("f", body_text({.unit = 12.0}));
  EXPECT_EQ(file.layout.unit, 0.01);
  ASSERT_EQ(file.notices.size(), 1u);
  EXPECT_THAT(file.notices[0].text, HasSubstr("0.0013 m tall and may well be wrong"));
}

TEST(BvhGuess, AnUnusualStatureIsReported) {
  // 46 inches of bones: a child, or another unit.
  const File file = read_text("f", body_text({.unit = 0.035}));
  ASSERT_EQ(file.notices.size(), 1u);
  EXPECT_THAT(file.notices[0].text, HasSubstr("which is unusual"));
}

TEST(BvhGuess, ABodyUpsideDownOrLyingIsReported) {
  const File down = read_text("f", body_text({.root_rotation = "180 0 0"}));
  ASSERT_EQ(down.notices.size(), 2u);
  EXPECT_THAT(down.notices[1].text, HasSubstr("the head is below the feet"));
  const File lying = read_text("f", body_text({.root_rotation = "90 0 0"}));
  EXPECT_EQ(lying.layout.up, UpAxis::y);
  EXPECT_THAT(lying.notices[0].text, HasSubstr("the body gives no clear answer"));
}

TEST(BvhGuess, ASkeletonWithoutExtentIsStillRead) {
  const File file = read_text("f", one_joint("CHANNELS 3 Xrotation Yrotation Zrotation", "1 2 3", "0 0 0"));
  EXPECT_EQ(file.layout.unit, 0.01);
  EXPECT_EQ(file.layout.up, UpAxis::y);
}

}  // namespace
}  // namespace signweave::bvh
