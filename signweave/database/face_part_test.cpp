#include "signweave/database/face_part.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "signweave/database/import.h"
#include "signweave/database/test_recording.h"
#include "signweave/formats/gltf/gltf.h"

namespace signweave {
namespace {

using namespace testing_database;
using testing::Contains;
using testing::HasSubstr;

/// A capture of two rows a second apart, from 10:00:10: jawOpen rises from 0 to 1.
const char* const kFaceText = "Timecode,BlendShapeCount,JawOpen\n10:00:10:00,1,0\n10:00:10:30,1,0.5\n10:00:11:00,1,1\n";

class FacePart : public testing::Test {
 protected:
  FacePart() {
    Database::create(folder_ / "db", {});
    const Motion motion = small_motion(200, 1);  // 2 s at 100 frames a second
    bvh::write(folder_ / "a.bvh", motion, bvh::default_layout(motion.skeleton()));
    std::ofstream(folder_ / "a.face.csv") << kFaceText;
  }
  ImportReport import(const ImportOptions& options) {
    Database database(folder_ / "db", kv::Access::read_write);
    return import_recording(database, pair_files({folder_ / "a.bvh"}).jobs.at(0), options);
  }
  /// Returns jawOpen of the stored motion at a frame.
  float jaw(std::size_t frame) const {
    return Database(folder_ / "db", kv::Access::read_only).read("a").tracks().at(0).values.at(frame);
  }
  std::string fault(const ImportOptions& options) {
    try {
      import(options);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
  TestFolder folder_;
};

TEST_F(FacePart, BeginsWithTheMotionUnlessGivenOtherwise) {
  import({});
  EXPECT_NEAR(jaw(50), 0.5f, 1e-6f);
}

TEST_F(FacePart, BeginsAtAnOffsetOrATimecode) {
  ImportReport report = import({.face_offset = Seconds(0.75)});
  EXPECT_NEAR(jaw(125), 0.5f, 1e-6f);
  EXPECT_EQ(jaw(10), 0.0f);
  std::vector<std::string> texts;
  for (const Notice& notice : report.notices) texts.push_back(notice.text);
  EXPECT_THAT(texts, Contains(HasSubstr("the face begins 0.8 s after the motion; its first values are held before")));
  // The motion began half a second before the face.
  import({.face_timecode = "10:00:09:30", .replace_motion = true});
  EXPECT_NEAR(jaw(100), 0.5f, 1e-6f);
}

TEST_F(FacePart, KeepsItsOffsetUntilAnotherIsGiven) {
  import({.face_offset = Seconds(0.5)});
  EXPECT_EQ(import({}).outcome, ImportOutcome::unchanged);
  EXPECT_EQ(import({.face_offset = Seconds(0.5)}).outcome, ImportOutcome::unchanged);
  EXPECT_THAT(fault({.face_offset = Seconds(0.25)}),
              HasSubstr("a.face.csv: lies elsewhere in the motion than the face that recording 'a' was imported with"));
  EXPECT_NEAR(jaw(100), 0.5f, 1e-6f);
  EXPECT_EQ(import({.face_offset = Seconds(0.25), .replace_motion = true}).outcome, ImportOutcome::motion_replaced);
  EXPECT_NEAR(jaw(75), 0.5f, 1e-6f);
}

TEST_F(FacePart, IsRefusedOutsideOfTheMotion) {
  EXPECT_THAT(fault({.face_offset = Seconds(2.5)}), HasSubstr("the face, from 2.500 to 3.500 s of the motion, lies "
                                                              "outside of its 2.000 s"));
  EXPECT_THAT(fault({.face_timecode = "09:00:00:00"}), HasSubstr("lies outside"));
  EXPECT_THAT(fault({.face_timecode = "nine"}), HasSubstr("face_timecode: 'nine' is not a timecode"));
}

TEST_F(FacePart, ItsTracksReplaceTheMotionsOwnOfTheSameName) {
  Motion motion = small_motion(200, 1);
  motion.add_track({"smile", std::vector<float>(200, 0.25f)});
  motion.add_track({"jawOpen", std::vector<float>(200, 0.75f)});
  std::vector<Notice> notices;
  EXPECT_EQ(add_face(folder_ / "a.face.csv", Seconds(0), motion, notices), 1u);
  ASSERT_EQ(motion.tracks().size(), 2u);
  EXPECT_EQ(motion.tracks()[0].name, "smile");
  EXPECT_EQ(motion.tracks()[1].name, "jawOpen");
  EXPECT_NEAR(motion.tracks()[1].values[50], 0.5f, 1e-6f);
  EXPECT_THAT(notices.at(0).text, HasSubstr("the face ends 1.0 s before"));
  EXPECT_THAT(notices.at(1).text, HasSubstr("1 track of the motion file take their values from the face"));
}

TEST_F(FacePart, ReplacedTracksOfTheMotionReturnWhenAnotherFaceLacksThem) {
  Motion motion = small_motion(200, 1);
  motion.add_track({"jawOpen", std::vector<float>(200, 0.75f)});
  gltf::write(folder_ / "g.glb", motion, {.name = "g"});
  const auto import_g = [&](const ImportOptions& options) {
    Database database(folder_ / "db", kv::Access::read_write);
    return import_recording(database, pair_files({folder_ / "g.glb"}).jobs.at(0), options).outcome;
  };
  const auto track = [&](std::string_view name) -> std::optional<float> {
    const Motion stored = Database(folder_ / "db", kv::Access::read_only).read("g");
    for (const ScalarTrack& one : stored.tracks()) {
      if (one.name == name) return one.values.at(100);
    }
    return std::nullopt;
  };
  EXPECT_EQ(import_g({}), ImportOutcome::added);
  EXPECT_NEAR(track("jawOpen").value(), 0.75f, 1e-6f);
  std::ofstream(folder_ / "g.face.csv") << kFaceText;
  EXPECT_EQ(import_g({}), ImportOutcome::face_added);
  EXPECT_NEAR(track("jawOpen").value(), 1.0f, 1e-6f);
  std::ofstream(folder_ / "g.face.csv") << "Timecode,BlendShapeCount,TongueOut\n10:00:10:00,1,0.5\n";
  EXPECT_EQ(import_g({.replace_motion = true}), ImportOutcome::motion_replaced);
  EXPECT_NEAR(track("jawOpen").value(), 0.75f, 1e-6f);
  EXPECT_NEAR(track("tongueOut").value(), 0.5f, 1e-6f);
  EXPECT_EQ(import_g({}), ImportOutcome::unchanged);
}

TEST_F(FacePart, ATableGivesItsOffset) {
  std::ofstream(folder_ / "other.face.csv") << kFaceText;
  std::ofstream(folder_ / "pairs.csv")
      << "motion,annotation,signer,offset,face,face offset\na.bvh,,,,other.face.csv,250\n";
  const Pairing pairing = pair_files({}, folder_ / "pairs.csv");
  ASSERT_EQ(pairing.jobs.size(), 1u);
  EXPECT_EQ(pairing.jobs[0].face, folder_ / "other.face.csv");
  EXPECT_EQ(pairing.jobs[0].face_offset, Seconds(0.25));
  for (const char* row :
       {",a.eaf,,,other.face.csv,", "a.bvh,,,,a.bvh,", "a.bvh,,,,,250", "a.bvh,,,,other.face.csv,x"}) {
    std::ofstream(folder_ / "pairs.csv") << row << '\n';
    EXPECT_THROW(pair_files({}, folder_ / "pairs.csv"), Error) << row;
  }
}

}  // namespace
}  // namespace signweave
