#include "signweave/formats/gltf/read.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "signweave/core/atomic_file.h"
#include "signweave/formats/gltf/gltf.h"
#include "signweave/motion/kinematics.h"

namespace signweave::gltf {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3f;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// The files are made by testdata/gltf/make.py; what is expected of them was reckoned by hand.
const fs::path kGltfFolder = fs::path(SIGNWEAVE_SOURCE_DIR) / "testdata" / "gltf";

std::vector<std::string> names_of(const Motion& motion) {
  std::vector<std::string> names;
  for (const Joint& joint : motion.skeleton().joints()) names.push_back(joint.name);
  return names;
}

std::vector<std::string> texts_of(const ReadFile& file) {
  std::vector<std::string> texts;
  for (const Notice& notice : file.notices) texts.push_back(notice.text);
  return texts;
}

Vector3f place_of(const Motion& motion, const char* joint, std::int64_t frame) {
  const ModelPose pose = to_model_space(motion.skeleton(), motion.pose(frame));
  return pose.positions.at(static_cast<std::size_t>(motion.skeleton().find(joint).value()));
}

void expect_near(const Vector3f& actual, const Vector3f& expected) {
  EXPECT_LT((actual - expected).norm(), 2e-6f) << actual.transpose() << " is not " << expected.transpose();
}

/// Degrees about z that a joint is turned in its parent.
float turn_of(const Motion& motion, const char* joint, std::int64_t frame) {
  const auto index = static_cast<std::size_t>(motion.skeleton().find(joint).value());
  const Eigen::Quaternionf q = motion.pose(frame).rotations[index];
  EXPECT_NEAR(q.norm(), 1, 1e-6);
  const float degrees = 2 * std::atan2(q.z(), q.w()) * 180 / std::numbers::pi_v<float>;
  return degrees < -1 ? degrees + 360 : degrees > 359 ? degrees - 360 : degrees;
}

std::string fault_of_bytes(const std::string& bytes, const ReadOptions& options = {}) {
  try {
    read_bytes("a.glb", bytes, {}, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "no fault";
}

TEST(GltfRead, KeysOfASkinBecomeFrames) {
  const ReadFile file = read(kGltfFolder / "linear.glb");
  EXPECT_THAT(names_of(file.motion), ElementsAre("Hips", "Someone:LeftArm", "Someone:LeftHand"));
  EXPECT_EQ(file.take, "take");
  EXPECT_THAT(texts_of(file), IsEmpty());
  EXPECT_EQ(file.motion.rate(), (FrameRate{30, 1}));
  ASSERT_EQ(file.motion.frame_count(), 5);
  EXPECT_THAT(file.motion.skeleton().translated_joints(), ElementsAre(0));
  expect_near(place_of(file.motion, "Someone:LeftHand", 0), {1, 1, 0});
  expect_near(place_of(file.motion, "Someone:LeftHand", 4), {0.5, 2.5, 0});
  EXPECT_NEAR(turn_of(file.motion, "Someone:LeftArm", 3), 67.5, 1e-4);
  EXPECT_TRUE(keeps_hemisphere(file.motion));
}

TEST(GltfRead, StepsHoldUntilTheNextKeyAndBuffersMayLieBesideTheFile) {
  const Motion motion = read(kGltfFolder / "step.gltf").motion;
  EXPECT_EQ(motion.rate(), (FrameRate{30, 1}));
  ASSERT_EQ(motion.frame_count(), 31);
  expect_near(place_of(motion, "Someone:LeftHand", 14), {1, 1, 0});
  expect_near(place_of(motion, "Someone:LeftHand", 15), {0.5, 1.5, 0});
  expect_near(place_of(motion, "Someone:LeftHand", 29), {0.5, 1.5, 0});
  expect_near(place_of(motion, "Someone:LeftHand", 30), {1, 1, 0});
  EXPECT_NEAR(turn_of(motion, "Someone:LeftHand", 17), 17, 1e-4);
}

TEST(GltfRead, CubicCurvesUseTangentsTimesTheirDistance) {
  const ReadFile file = read(kGltfFolder / "cubic.glb");
  EXPECT_THAT(texts_of(file), IsEmpty());
  EXPECT_EQ(file.motion.rate(), (FrameRate{60, 1})) << "keys seconds apart say little of a curve";
  ASSERT_EQ(file.motion.frame_count(), 181);
  expect_near(place_of(file.motion, "Someone:LeftArm", 60), {1, 1, 0});
  expect_near(place_of(file.motion, "Someone:LeftArm", 150), {1, 1, 0});
  EXPECT_NEAR(turn_of(file.motion, "Someone:LeftHand", 60), 45, 1e-4);
  EXPECT_NEAR(turn_of(file.motion, "Someone:LeftHand", 180), 90, 1e-4);
}

TEST(GltfRead, UnevenKeysAreReadAt120AndTheLossIsTold) {
  const ReadFile file = read(kGltfFolder / "uneven.glb");
  EXPECT_THAT(texts_of(file),
              ElementsAre("its first key is at 0.1 seconds; that is the motion's first frame",
                          "its keys stand unevenly and were read at 120 frames a second, so at its keys the motion is "
                          "off by up to 1.3 degrees (node 1 'Someone:LeftArm') and 0.025 mm (node 1 "
                          "'Someone:LeftArm'); --source-rate overrides"));
  ASSERT_EQ(file.motion.frame_count(), 37);
  EXPECT_NEAR(turn_of(file.motion, "Someone:LeftArm", 36), 90, 1e-4);
  EXPECT_NEAR(turn_of(file.motion, "Someone:LeftArm", 4), 30 * 4 / 4.44, 1e-4);
  expect_near(place_of(file.motion, "Someone:LeftArm", 12), {0.6f, 1, 0});
}

TEST(GltfRead, ARateThatIsAskedForIsTheMotions) {
  const ReadFile file = read(kGltfFolder / "linear.glb", {.take = {}, .rate = FrameRate{50, 1}});
  EXPECT_EQ(file.motion.rate(), (FrameRate{50, 1}));
  ASSERT_EQ(file.motion.frame_count(), 8) << "4/30 of a second is 6.67 frames";
  EXPECT_NEAR(turn_of(file.motion, "Someone:LeftArm", 1), 22.5 * 30 / 50, 1e-4);
  EXPECT_THAT(texts_of(file), ElementsAre(HasSubstr("its keys do not stand at 50 frames a second")));
}

TEST(GltfRead, ATakeIsChosenByNameOrNumber) {
  const ReadFile first = read(kGltfFolder / "two_takes.gltf");
  EXPECT_EQ(first.take, "rest");
  EXPECT_THAT(texts_of(first),
              ElementsAre("it has 3 takes, 'rest', 'wave', '3'; the first was read, --take reads another"));
  const ReadFile named = read(kGltfFolder / "two_takes.gltf", {.take = "wave"});
  EXPECT_EQ(named.motion.rate(), (FrameRate{25, 1}));
  EXPECT_NEAR(turn_of(named.motion, "Someone:LeftArm", 2), 90, 1e-4);
  EXPECT_THAT(texts_of(named), IsEmpty());
  const ReadFile numbered = read(kGltfFolder / "two_takes.gltf", {.take = "3"});
  EXPECT_EQ(numbered.take, "3");
  EXPECT_NEAR(turn_of(numbered.motion, "Someone:LeftArm", 2), 45, 1e-4);
  EXPECT_THAT(names_of(numbered.motion), ElementsAre("Hips", "Someone:LeftArm", "Someone:LeftHand"));
  EXPECT_THAT(texts_of(numbered), IsEmpty()) << "cameras are not missed";
  try {
    read(kGltfFolder / "two_takes.gltf", {.take = "4"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_found);
    EXPECT_THAT(error.what(), HasSubstr("no take '4'; it has 'rest', 'wave', '3'"));
  }
}

TEST(GltfRead, HelpersAboveTheRootAreAppliedToIt) {
  const ReadFile file = read(kGltfFolder / "armature.glb");
  EXPECT_THAT(names_of(file.motion), ElementsAre("Hips", "Spine", "Head"));
  EXPECT_THAT(texts_of(file), IsEmpty());
  EXPECT_EQ(file.motion.rate(), (FrameRate{24, 1}));
  expect_near(place_of(file.motion, "Hips", 0), {0, 1, 0});
  expect_near(place_of(file.motion, "Spine", 0), {0, 1.2f, 0});
  expect_near(place_of(file.motion, "Head", 0), {0, 1.5f, 0});
  expect_near(place_of(file.motion, "Head", 2), {0, 1.7f, 0});
  EXPECT_NEAR(turn_of(file.motion, "Spine", 0), 90, 1e-4) << "out of its matrix";
}

TEST(GltfRead, MorphWeightsBecomeTracks) {
  const ReadFile file = read(kGltfFolder / "morph.glb");
  const std::vector<ScalarTrack>& tracks = file.motion.tracks();
  EXPECT_THAT(tracks, ElementsAre(ScalarTrack{"jawOpen", {0, 0.5f, 1}}, ScalarTrack{"eyeBlinkLeft", {1, 0.5f, 0}},
                                  ScalarTrack{"teeth.weight.0", {0, 0.2f, 1}},
                                  ScalarTrack{"brows.eyeBlinkLeft", {0.25f, 0.25f, 0.25f}}));
  EXPECT_EQ(file.motion.rate(), (FrameRate{10, 1}));
}

TEST(GltfRead, QuantisedRotationsAreMadeUnit) {
  const Motion motion = read(kGltfFolder / "quantised.glb").motion;
  EXPECT_EQ(motion.rate(), (FrameRate{60, 1}));
  EXPECT_NEAR(turn_of(motion, "Someone:LeftArm", 1), 90, 1e-4);
  EXPECT_NEAR(turn_of(motion, "Someone:LeftArm", 2), 270, 1e-4) << "below 0, and the lowest number there is";
  const Eigen::Quaternionf hand = motion.pose(1).rotations[2];
  EXPECT_NEAR(hand.y(), std::sqrt(0.5f), 1e-6);
}

TEST(GltfRead, InterleavedAndSparseNumbersAreFound) {
  const Motion motion = read(kGltfFolder / "sparse.glb").motion;
  EXPECT_EQ(motion.rate(), (FrameRate{50, 1}));
  expect_near(place_of(motion, "Someone:LeftArm", 0), {0, 1, 0});
  expect_near(place_of(motion, "Someone:LeftArm", 1), {0, 1.25f, 0});
  expect_near(place_of(motion, "Someone:LeftHand", 2), {-0.5f, 1, 0});
}

TEST(GltfRead, PackedBuffersAreUnpacked) {
  const Motion motion = read(kGltfFolder / "meshopt.glb").motion;
  EXPECT_EQ(motion.rate(), (FrameRate{50, 1}));
  ASSERT_EQ(motion.frame_count(), 9);
  for (std::int64_t frame = 0; frame < 9; ++frame) {
    EXPECT_NEAR(turn_of(motion, "Someone:LeftArm", frame), 10 * static_cast<float>(frame), 0.01);
  }
}

TEST(GltfRead, SkinsThatShareJointsAreOneAndOtherTreesAreTold) {
  const ReadFile file = read(kGltfFolder / "two_skins.glb");
  EXPECT_THAT(names_of(file.motion), ElementsAre("Hips", "Someone:LeftArm", "Someone:LeftHand", "Sleeve"));
  EXPECT_THAT(texts_of(file), ElementsAre("node 7 'Child' with 2 joints was left out: a motion has one root, and that "
                                          "is under node 0 'Hips'"));
}

TEST(GltfRead, WithoutASkinTheMovedNodesAndAllBelowAreJoints) {
  const ReadFile file = read(kGltfFolder / "bare.gltf");
  EXPECT_THAT(names_of(file.motion), ElementsAre("Root", "Arm", "Hand"));
  EXPECT_THAT(texts_of(file), IsEmpty());
  expect_near(place_of(file.motion, "Hand", 0), {0.75f, 0, 2});
  expect_near(place_of(file.motion, "Hand", 1), {0.5f, 0.5f, 1.75f});
}

TEST(GltfRead, ABrokenBindPoseIsToldAndChangesNothing) {
  const ReadFile file = read(kGltfFolder / "bent_bind.glb");
  EXPECT_THAT(texts_of(file),
              ElementsAre("skin 0: 1 bind matrices are singular or not finite, such as that of node 1 "
                          "'Someone:LeftArm'; only the nodes were read",
                          "skin 1: its bind pose is not that of the nodes, by up to 90.0 degrees and 250.0 mm (node 1 "
                          "'Someone:LeftArm'); only the nodes were read"));
  expect_near(place_of(file.motion, "Someone:LeftHand", 0), {1, 1, 0});
}

TEST(GltfRead, ScalesByAxisAreFoldedWhereNothingShears) {
  const ReadFile file = read(kGltfFolder / "squashed.glb");
  EXPECT_THAT(texts_of(file), ElementsAre("node 0 'Hips': its scale 2, 1, 1 was multiplied into what is below it"));
  expect_near(place_of(file.motion, "Someone:LeftArm", 0), {1, 1, 0});
  expect_near(place_of(file.motion, "Someone:LeftHand", 1), {1, 2.5f, 0});
}

TEST(GltfRead, AScaleOfTheRootThatChangesIsBakedIntoWhereTheJointsAre) {
  const ReadFile file = read(kGltfFolder / "growing.glb");
  EXPECT_THAT(texts_of(file), ElementsAre("node 0 'Root': its scale changes (animation 0, channel 1); that was baked "
                                          "into where the joints below it are"));
  EXPECT_THAT(file.motion.skeleton().translated_joints(), ElementsAre(1, 2));
  const std::int64_t last = file.motion.frame_count() - 1;
  expect_near(place_of(file.motion, "Hand", 0), {0, 1, 0});
  expect_near(place_of(file.motion, "Finger", 0), {0.5f, 1, 0});
  expect_near(place_of(file.motion, "Hand", last), {-2, 0, 0});
  expect_near(place_of(file.motion, "Finger", last), {-2, 2, 0});
}

TEST(GltfRead, TracksInTheExtrasComeBack) {
  const ReadFile file = read(kGltfFolder / "tracks.glb");
  EXPECT_THAT(file.motion.tracks(),
              ElementsAre(ScalarTrack{"gaze", {0, 0.25f, 0.5f, 0.75f, 1}}, ScalarTrack{"slow", {0, 0.5f, 1, 2, 3}}));
  EXPECT_THAT(texts_of(file), ElementsAre("animation 0: 1 'tracks' in its extras that are not name, rate and numbers "
                                          "were left out"));
}

TEST(GltfRead, AnOddStatureIsTold) {
  const auto skeleton = std::make_shared<const Skeleton>(
      std::vector<Joint>{{.name = "Hips"}, {.name = "Head", .parent = 0, .offset = {0, 170, 0}}}, std::vector<Tip>());
  const std::string bytes = to_bytes(Motion(skeleton, {50, 1}, 3), {}, Container::binary);
  EXPECT_THAT(
      texts_of(read_bytes("a.glb", bytes, {})),
      testing::Contains("its joints span 170 metres, as if it were in centimetres; --unit 0.01 would mend that"));
  const ReadFile file = read_bytes("a.glb", bytes, {}, {.take = {}, .unit = 0.01});
  expect_near(file.motion.skeleton().joint(1).offset, {0, 1.7f, 0});
}

// Two keys a thirtieth of a second apart are next to frames of 29.97 too.
TEST(GltfRead, OfTwoRatesThatFitTheNearerIsTaken) {
  for (const FrameRate rate : {FrameRate{30, 1}, FrameRate{30'000, 1'001}, FrameRate{5, 1}, FrameRate{37, 1}}) {
    const auto skeleton =
        std::make_shared<const Skeleton>(std::vector<Joint>{{.name = "Hips", .translated = true}}, std::vector<Tip>());
    Motion motion(skeleton, rate, 2);
    motion.pose(1).translations[0] = {0, 1, 0};
    EXPECT_EQ(read_bytes("a.glb", to_bytes(motion, {}, Container::binary), {}).motion.rate(), rate);
  }
}

TEST(GltfRead, OutsideBuffersAreNamedAndNeedAFolder) {
  EXPECT_THAT(files_of(kGltfFolder / "step.gltf"),
              ElementsAre(kGltfFolder / "step.gltf", kGltfFolder / "step keys.bin"));
  EXPECT_THAT(files_of(kGltfFolder / "linear.glb"), ElementsAre(kGltfFolder / "linear.glb"));
  EXPECT_THAT(fault_of_bytes(read_file(kGltfFolder / "step.gltf")),
              HasSubstr("buffer 0: it lies in another file, 'step keys.bin'; export as .glb"));
}

TEST(GltfRead, AMotionFarLargerThanItsFileIsRefusedBeforeItIsMade) {
  const std::string bytes = read_file(kGltfFolder / "linear.glb");
  EXPECT_THAT(
      fault_of_bytes(
          bytes, {.take = {}, .rate = FrameRate{1'000'000, 1}, .unit = {}, .progress = {}, .most_growth = 1'000'000}),
      HasSubstr("133335 frames of 3 joints would be larger than what a file of its size may become"));
}

TEST(GltfRead, ProgressMayCancel) {
  const std::string bytes = read_file(kGltfFolder / "linear.glb");
  ReadOptions options;
  options.progress = [](double) { throw Error(ErrorCode::cancelled, "stopped"); };
  EXPECT_EQ(fault_of_bytes(bytes, options), "stopped");
}

// A file cut anywhere must be refused and never crash.
TEST(GltfRead, AFileCutAnywhereIsRefused) {
  for (const char* const name : {"armature.glb", "meshopt.glb", "bare.gltf"}) {
    const std::string bytes = read_file(kGltfFolder / name);
    const std::size_t whole = bytes.find_last_not_of('\n') + 1;
    for (std::size_t size = 0; size < whole; ++size) {
      EXPECT_THROW(read_bytes("cut", std::string_view(bytes).substr(0, size), {}), Error) << name << " at " << size;
    }
  }
}

}  // namespace
}  // namespace signweave::gltf
