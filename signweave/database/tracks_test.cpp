#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "signweave/database/import.h"
#include "signweave/database/test_recording.h"
#include "signweave/features/gaze.h"
#include "signweave/formats/eaf/eaf.h"
#include "signweave/formats/face/face_csv.h"
#include "signweave/query/parse.h"
#include "signweave/rig/test_rig.h"

namespace signweave {
namespace {

using namespace testing_database;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Queries of face captures imported with motions. A recording has signs A to E of 400 ms, each with its stroke from
/// 100 to 300 ms.
class TracksTest : public testing::Test {
 protected:
  TracksTest() {
    Database::create(folder_ / "db", {});
    std::filesystem::create_directories(files());
  }
  std::filesystem::path files() const { return folder_ / "files"; }

  void write_recording(const std::string& name, const Motion& motion) {
    bvh::write(files() / (name + ".bvh"), motion, bvh::default_layout(motion.skeleton()));
    eaf::write(files() / (name + ".eaf"), small_document({"A", "B", "C", "D", "E"}));
  }
  /// Returns a face capture as the capture program writes it.
  void write_face(const std::string& name, const std::vector<ScalarTrack>& tracks) {
    Motion motion = small_motion(static_cast<std::int64_t>(tracks.front().values.size()), 1);
    for (const ScalarTrack& track : tracks) motion.add_track(track);
    std::ofstream(files() / (name + ".face.csv")) << face_csv::write_text(motion);
  }
  void import_all() {
    Database database(folder_ / "db", kv::Access::read_write);
    for (const ImportJob& job : pair_files({files()}).jobs) import_recording(database, job, {});
  }
  std::vector<std::string> found(const std::string& query, const FindLimits& limits = {}) const {
    const Database database(folder_ / "db", kv::Access::read_only);
    std::vector<std::string> names;
    for (const Segment& segment : database.find(parse(query), limits)) {
      names.push_back(segment.recording + " " + segment.name);
    }
    return names;
  }
  std::string fault(const std::string& query) const {
    try {
      found(query);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::not_found);
      return error.what();
    }
    return "no fault";
  }
  TestFolder folder_;
};

/// smile.csv: mouthSmileLeft is sin(1.5 t), the eyes blink at 0.73 and 0.80 s, browInnerUp is 0.4 throughout.
class SmileTest : public TracksTest {
 protected:
  SmileTest() {
    write_recording("smile", small_motion(200, 1));
    std::filesystem::copy_file(SIGNWEAVE_SOURCE_DIR "/testdata/face_csv/smile.csv", files() / "smile.face.csv");
    write_recording("plain", small_motion(200, 2));
    import_all();
  }
};

TEST_F(SmileTest, AStrokeIsFoundByTheFaceTracksInIt) {
  EXPECT_THAT(found("phase = stroke & track(mouthSmileLeft) > 0.8"),
              ElementsAre("smile B stroke", "smile C stroke", "smile D stroke"));
  EXPECT_THAT(found("gloss =~ /.*/ & track(mouthSmileLeft) > 0.5"),
              ElementsAre("smile B", "smile C", "smile D", "smile E"));
  EXPECT_THAT(found("track(mouthSmileLeft).least > 0.8"), ElementsAre("smile C"));
  EXPECT_THAT(found("track(mouthSmileLeft).begin > 0.9 & track(mouthSmileLeft).end < 0.8"), ElementsAre("smile D"));
  EXPECT_THAT(found("tier(\"Phase\") =~ /.*/ & track(eyeBlinkLeft) > 0.9"),
              ElementsAre("smile B retraction", "smile C preparation"));
  EXPECT_THAT(found("gloss = A & mean_track(browInnerUp) > 0.39 & mean_track(browInnerUp) < 0.41"),
              ElementsAre("smile A"));
  EXPECT_THAT(found("gloss = A & track(MouthSmileLeft) > 0"), ElementsAre("smile A")) << "as the file spells it";
}

TEST_F(SmileTest, AColumnThatWasLeftOutIsZeroWithAFaceAndUnknownWithout) {
  EXPECT_THAT(found("gloss =~ /[AB]/ & track(jawOpen) <= 0"), ElementsAre("smile A", "smile B"));
  EXPECT_THAT(found("track(jawOpen) > 0"), IsEmpty());
  EXPECT_THAT(found("gloss = A & !(track(jawOpen) <= 0)"), ElementsAre("plain A"));
  EXPECT_THAT(found("gloss = A & !(track(jawOpen) > 0)"), ElementsAre("plain A", "smile A"));
}

TEST_F(SmileTest, ATrackThatNoRecordingHasIsAnError) {
  EXPECT_EQ(fault("gloss = A & track(jawOpn) > 0"),
            "track(\"jawOpn\"): no recording of this database has such a scalar track; did you mean jawOpen?");
  {
    Database database(folder_ / "db", kv::Access::read_write);
    database.remove("smile");
  }
  EXPECT_THAT(fault("track(jawOpen) > 0"), HasSubstr("import a face capture, NAME.face.csv, with its motion"));
}

TEST_F(SmileTest, WithoutEyesThereIsNoGaze) {
  EXPECT_THAT(found("gaze(yaw) > 0 deg"), IsEmpty());
  EXPECT_THAT(found("gaze(yaw) <= 0 deg"), IsEmpty());
  EXPECT_EQ(found("gloss = A & !(gaze(yaw) <= 0 deg)").size(), 2u);
}

TEST_F(SmileTest, StopsWhenItIsCancelled) {
  const std::atomic<bool> cancel = true;
  FindLimits limits;
  limits.cancel = &cancel;
  EXPECT_THROW(found("track(mouthSmileLeft) > 0.8", limits), Error);
}

TEST_F(SmileTest, EveryAccessModeGivesTheSameAnswers) {
  Database database(folder_ / "db", kv::Access::read_write);
  for (const char* mode : {"full", "by_frame:16", "by_joint", "by_joint_and_frame:16"}) {
    database.relayout("smile", {.mode = parse_access_mode(mode), .tolerance = {}});
    EXPECT_EQ(database.find(parse("track(mouthSmileLeft) > 0.8")).size(), 3u) << mode;
  }
}

/// Looks 20 degrees left in the first second, 15 right and 10 up in the next.
Gaze made_gaze(std::int64_t frame) {
  return frame < 100 ? Gaze{20, 0} : Gaze{-15, 10};
}

TEST_F(TracksTest, GazeIsFoundFromEyeTracksWeightsAndJointsAlike) {
  constexpr float kRadian = std::numbers::pi_v<float> / 180;
  std::vector<ScalarTrack> rotations = {
      {"leftEyeYaw", {}}, {"leftEyePitch", {}}, {"rightEyeYaw", {}}, {"rightEyePitch", {}}};
  std::vector<ScalarTrack> weights = {{"eyeLookOutLeft", {}},  {"eyeLookInRight", {}}, {"eyeLookInLeft", {}},
                                      {"eyeLookOutRight", {}}, {"eyeLookUpLeft", {}},  {"eyeLookUpRight", {}}};
  Motion joints = moving(whole_person(), 200, 3);
  for (std::int64_t frame = 0; frame < 200; ++frame) {
    const Gaze gaze = made_gaze(frame);
    for (std::size_t i = 0; i < 4; ++i) rotations[i].values.push_back(-(i % 2 == 0 ? gaze.yaw : gaze.pitch) * kRadian);
    for (std::size_t i = 0; i < 6; ++i) {
      const float angle = i < 2 ? gaze.yaw : i < 4 ? -gaze.yaw : gaze.pitch;
      weights[i].values.push_back(std::max(angle, 0.0f) / (i < 4 ? kLookAcross : kLookUp));
    }
    for (const char* eye : {"LeftEye", "RightEye"}) {
      joints.pose(frame).rotations[static_cast<std::size_t>(*joints.skeleton().find(eye))] =
          Eigen::AngleAxisf(gaze.yaw * kRadian, Eigen::Vector3f::UnitY()) *
          Eigen::AngleAxisf(-gaze.pitch * kRadian, Eigen::Vector3f::UnitX());
    }
  }
  write_recording("joints", joints);
  write_recording("rotations", small_motion(200, 1));
  write_face("rotations", rotations);
  write_recording("weights", small_motion(200, 2));
  write_face("weights", weights);
  import_all();
  const auto all = [](const char* sign) {
    return ElementsAre(std::string("joints ") + sign, std::string("rotations ") + sign, std::string("weights ") + sign);
  };
  // The strokes of A and B are over before the first second is, D and E begin after it.
  EXPECT_THAT(found("gloss = A & gaze(yaw) > 19.5 deg & gaze(yaw).least < 20.5 deg"), all("A"));
  EXPECT_THAT(found("gloss = A & gaze(yaw).least > 19.5 deg & gaze(pitch) < 0.5 deg"), all("A"));
  EXPECT_THAT(found("gloss = E & mean_gaze(yaw) < -14.5 deg & mean_gaze(yaw) > -15.5 deg"), all("E"));
  EXPECT_THAT(found("gloss = E & mean_gaze(pitch) > 9.5 deg & mean_gaze(pitch) < 10.5 deg"), all("E"));
  EXPECT_THAT(found("gaze(yaw).begin > 15 deg & gaze(yaw).end < -10 deg"), all("C"));
  EXPECT_EQ(found("gaze(yaw) < -14 deg").size(), 6u);
}

}  // namespace
}  // namespace signweave
