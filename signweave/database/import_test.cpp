#include "signweave/database/import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/core/atomic_file.h"
#include "signweave/database/check.h"
#include "signweave/database/test_import.h"
#include "signweave/formats/eaf/eaf.h"
#include "signweave/query/parse.h"

namespace signweave {
namespace {

using namespace testing_database;
using testing::ElementsAre;
using testing::HasSubstr;

TEST_F(ImportTest, ASecondImportStoresOnlyWhatChanged) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"});
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::added));
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::unchanged));
  write_annotation("a.eaf", {"B"});
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::annotation_replaced));
  EXPECT_EQ(Database(folder_ / "db", kv::Access::read_only).find(parse("gloss = \"B\"")).size(), 1u);
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::unchanged));
}

TEST_F(ImportTest, AChangedMotionIsImportedOnlyOnRequest) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"});
  import_all();
  const Motion before = Database(folder_ / "db", kv::Access::read_only).read("a");
  write_motion("a.bvh", 2);
  try {
    import_all();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("replace it"));
  }
  EXPECT_TRUE(same_poses(Database(folder_ / "db", kv::Access::read_only).read("a"), before));
  EXPECT_THAT(import_all({.replace_motion = true}), ElementsAre(ImportOutcome::motion_replaced));
  EXPECT_FALSE(same_poses(Database(folder_ / "db", kv::Access::read_only).read("a"), before));
}

TEST_F(ImportTest, ABrokenFileChangesNothingOfItsRecording) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"});
  import_all();
  write_text("a.eaf", "<ANNOTATION_DOCUMENT><TIME_ORDER>");
  EXPECT_THROW(import_all(), Error);
  EXPECT_EQ(Database(folder_ / "db", kv::Access::read_only).find(parse("gloss = \"A\"")).size(), 1u);
}

TEST_F(ImportTest, HalvesAreImportedInAnyOrder) {
  write_annotation("a.eaf", {"A"});
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::added));
  EXPECT_THAT(notices_, testing::Contains(HasSubstr("annotation without motion")));
  write_motion("a.bvh", 1);
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::motion_added));
  const Database database(folder_ / "db", kv::Access::read_only);
  EXPECT_EQ(database.read(database.find(parse("phase = stroke")).at(0)).frame_count(), 20);
}

TEST_F(ImportTest, TheClockComesFromTheLinkedFileOrFromOptions) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"}, {{.url = "a.bvh", .mime_type = "x", .time_origin = 250ms, .media = false}});
  import_all();
  EXPECT_NEAR(Database(folder_ / "db", kv::Access::read_only).info("a")->clock.origin.count(), -0.25, 1e-9);
  import_all({.offset = Seconds(0.1)});
  EXPECT_NEAR(Database(folder_ / "db", kv::Access::read_only).info("a")->clock.origin.count(), 0.1, 1e-9);
  import_all({.sync = {{0, Seconds(1)}, {100, Seconds(2.001)}}});
  const FrameClock clock = Database(folder_ / "db", kv::Access::read_only).info("a")->clock;
  EXPECT_NEAR(clock.origin.count(), 1.0, 1e-9);
  EXPECT_NEAR(clock.frame_time.count(), 0.01001, 1e-9);
  EXPECT_THROW(import_all({.sync = {{0, Seconds(1)}, {0, Seconds(2)}}}), Error);
}

TEST_F(ImportTest, TheOptionsOfAnEarlierImportAreKept) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"});
  import_all({.offset = Seconds(0.7)});
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::unchanged));
  write_annotation("a.eaf", {"B"});
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::annotation_replaced));
  EXPECT_NEAR(Database(folder_ / "db", kv::Access::read_only).info("a")->clock.origin.count(), 0.7, 1e-9);
  EXPECT_THAT(import_all({.offset = Seconds(0)}), ElementsAre(ImportOutcome::clock_changed));
  EXPECT_NEAR(Database(folder_ / "db", kv::Access::read_only).info("a")->clock.origin.count(), 0.0, 1e-9);
}

TEST_F(ImportTest, GuessedTiersAreGuessedAgain) {
  write_motion("a.bvh", 1);
  AnnotationDocument document = small_document({"A"});
  document.tiers.pop_back();  // no phases yet
  eaf::write(files() / "a.eaf", document);
  import_all();
  write_annotation("a.eaf", {"A"});
  import_all();
  EXPECT_EQ(Database(folder_ / "db", kv::Access::read_only).find(parse("phase = preparation")).size(), 1u);
}

TEST_F(ImportTest, AnOffsetGivenWithTheAnnotationAppliesToALaterMotion) {
  write_annotation("a.eaf", {"A"});
  import_all({.offset = Seconds(0.7)});
  write_motion("a.bvh", 1);
  import_all();
  const FrameClock clock = Database(folder_ / "db", kv::Access::read_only).info("a")->clock;
  EXPECT_NEAR(clock.origin.count(), 0.7, 1e-9);
  EXPECT_NEAR(clock.frame_time.count(), 0.01, 1e-9);
}

TEST_F(ImportTest, AMotionOfAnotherRateKeepsTheOffsetAndTakesItsOwnRate) {
  write_motion("a.bvh", 1);
  import_all({.offset = Seconds(0.1)});
  Motion motion = small_motion(100, 1);
  const Motion slower(motion.shared_skeleton(), {50, 1}, 100);
  bvh::write(files() / "a.bvh", slower, bvh::default_layout(slower.skeleton()));
  import_all({.replace_motion = true});
  const FrameClock clock = Database(folder_ / "db", kv::Access::read_only).info("a")->clock;
  EXPECT_NEAR(clock.frame_time.count(), 0.02, 1e-9);
  EXPECT_NEAR(clock.origin.count(), 0.1, 1e-9);
}

TEST_F(ImportTest, ImportingADocumentAgainRepairsDamage) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"});
  import_all();
  {
    const auto store = kv::open(folder_ / "db", kv::Access::read_write);
    const auto transaction = store->write();
    ByteWriter key;
    key.number('D');
    key.number(Database(folder_ / "db", kv::Access::read_only).info("a")->document);
    const ByteSpan value = *transaction->get(key.bytes());
    Bytes damaged(value.begin(), value.end());
    damaged[100] ^= std::byte{1};
    transaction->put(key.bytes(), damaged);
    transaction->commit();
  }
  EXPECT_FALSE(check(Database(folder_ / "db", kv::Access::read_only)).faults.empty());
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::annotation_replaced));
  EXPECT_TRUE(check(Database(folder_ / "db", kv::Access::read_only)).faults.empty());
}

TEST_F(ImportTest, AClockThatNoRecordingCanHaveIsRefused) {
  write_motion("a.bvh", 1);
  EXPECT_THROW(import_all({.offset = Seconds(std::nan(""))}), Error);
  EXPECT_THROW(import_all({.offset = Seconds(1e300)}), Error);
  EXPECT_THROW(import_all({.sync = {{0, Seconds(0)}, {1, Seconds(1000)}}}), Error);
}

TEST_F(ImportTest, ALinkedFileIsRecognizedByItsWholeName) {
  write_motion("sign.bvh", 1);
  write_annotation("sign.eaf", {"A"},
                   {{.url = "file:///x/othersign.bvh", .mime_type = "x", .time_origin = 700ms, .media = false},
                    {.url = "file:///x/s%69gn.bvh", .mime_type = "x", .time_origin = 200ms, .media = false}});
  import_all();
  EXPECT_NEAR(Database(folder_ / "db", kv::Access::read_only).info("sign")->clock.origin.count(), -0.2, 1e-9);
}

TEST_F(ImportTest, AStoredRecordingKeepsItsNameWhenAnotherOfTheSameStemIsAdded) {
  write_motion("a.bvh", 1);
  import_all();
  write_motion("sub/a.bvh", 2);
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::unchanged, ImportOutcome::added));
  EXPECT_EQ(Database(folder_ / "db", kv::Access::read_only).contents()->recordings.size(), 2u);
}

TEST_F(ImportTest, ReplacingTheMotionRepairsDamage) {
  write_motion("a.bvh", 1);
  import_all();
  EXPECT_THAT(import_all({.replace_motion = true}), ElementsAre(ImportOutcome::motion_replaced));
}

TEST_F(ImportTest, SignsOutsideTheMotionAreReported) {
  write_motion("a.bvh", 1, 50);
  write_annotation("a.eaf", {"A", "B", "C"});
  import_all();
  EXPECT_THAT(notices_, testing::Contains(HasSubstr("2 of 3 signs lie outside the motion (the first: B at 400 ms)")));
}

TEST_F(ImportTest, NoticesAreStoredWithoutTheFoldersOfTheFiles) {
  write_motion("sub/a.bvh", 1, 50);
  write_annotation("sub/a.eaf", {"A", "B", "C"});
  import_all();
  const std::shared_ptr<const Contents> contents = Database(folder_ / "db", kv::Access::read_only).contents();
  std::vector<std::string> places;
  for (const Notice& notice : contents->recordings.at(0).notices) places.push_back(notice.where);
  EXPECT_THAT(places, testing::Contains("a.eaf"));
  EXPECT_THAT(places, testing::Contains("a.bvh"));
  EXPECT_THAT(places, testing::Not(testing::Contains(HasSubstr(files().string()))));
}

TEST_F(ImportTest, PhaseLabelsAreReadFromATable) {
  write_text("labels.txt", "# ours\nVorbereitung = preparation\n  Halten=stroke\n");
  const auto labels = read_phase_labels(files() / "labels.txt");
  EXPECT_EQ(labels.at("vorbereitung"), PhaseKind::preparation);
  EXPECT_EQ(labels.at("halten"), PhaseKind::stroke);
  write_text("wrong.txt", "\nA = B\n");
  EXPECT_THROW(read_phase_labels(files() / "wrong.txt"), Error);
}

TEST_F(ImportTest, TiersGivenAsNoneAreNotGuessed) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"});
  const auto tiers = [&] { return Database(folder_ / "db", kv::Access::read_only).info("a")->tiers; };
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::added));
  const TierNames guessed = tiers();
  ASSERT_FALSE(guessed.sign_tiers.empty());
  ASSERT_FALSE(guessed.phase_tiers.empty());
  EXPECT_THAT(import_all({.no_phase_tier = true}), ElementsAre(ImportOutcome::annotation_replaced));
  EXPECT_EQ(tiers().sign_tiers, guessed.sign_tiers);
  EXPECT_TRUE(tiers().phase_tiers.empty());
  // This also applies to later imports, until tiers are given.
  write_annotation("a.eaf", {"B"});
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::annotation_replaced));
  EXPECT_TRUE(tiers().phase_tiers.empty());
  EXPECT_THAT(import_all({.no_sign_tier = true}), ElementsAre(ImportOutcome::annotation_replaced));
  EXPECT_TRUE(tiers().sign_tiers.empty());
  EXPECT_THAT(notices_, testing::Not(testing::Contains(HasSubstr("tier"))));
  EXPECT_THAT(import_all({.phase_tiers = guessed.phase_tiers}), ElementsAre(ImportOutcome::annotation_replaced));
  EXPECT_EQ(tiers().phase_tiers, guessed.phase_tiers);
}

TEST_F(ImportTest, AnAnnotationReplacesOnlyTheOneThatItWasMadeFrom) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"});
  const auto stored = [&] {
    return annotation_fingerprint(*Database(folder_ / "db", kv::Access::read_only).info("a"));
  };
  EXPECT_THAT(import_all({.if_annotation = "none"}), ElementsAre(ImportOutcome::added));
  const std::string first = stored();
  EXPECT_EQ(first.size(), 16u);
  // The stored annotation may be sent again, as after a lost response.
  EXPECT_THAT(import_all({.if_annotation = "none"}), ElementsAre(ImportOutcome::unchanged));
  write_annotation("a.eaf", {"B"});
  for (const std::string other : {"none", "0123456789abcdef"}) {
    try {
      import_all({.replace_motion = true, .if_annotation = other});
      FAIL() << other;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::conflict);
      EXPECT_THAT(error.what(), HasSubstr("recording 'a' is no longer " + other + " but " + first + "; look at"));
    }
    EXPECT_EQ(stored(), first);
  }
  EXPECT_THAT(import_all({.if_annotation = first}), ElementsAre(ImportOutcome::annotation_replaced));
  EXPECT_NE(stored(), first);
  // The condition does not apply to an import of a motion alone.
  std::filesystem::remove(files() / "a.eaf");
  write_motion("b.bvh", 1);
  EXPECT_THAT(import_all({.if_annotation = first}), ElementsAre(ImportOutcome::unchanged, ImportOutcome::added));
  EXPECT_EQ(annotation_fingerprint(*Database(folder_ / "db", kv::Access::read_only).info("b")), "none");
}

TEST_F(ImportTest, AFaceIsImportedIfItOrItsMotionIsAnInput) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"});
  write_text("a.face.csv", face_text("0.5"));
  write_text("pairs.csv", "a.bvh,a.eaf\n");
  for (const Pairing& pairing : {pair_files({files() / "a.bvh", files() / "a.eaf"}),
                                 pair_files({files() / "a.face.csv"}), pair_files({}, files() / "pairs.csv")}) {
    ASSERT_EQ(pairing.jobs.size(), 1u);
    EXPECT_EQ(pairing.jobs[0].motion, files() / "a.bvh");
    EXPECT_EQ(pairing.jobs[0].face, files() / "a.face.csv");
    EXPECT_TRUE(pairing.notices.empty());
  }
}

TEST_F(ImportTest, AnotherFaceKeepsTheOptionsOfTheMotion) {
  write_motion("a.bvh", 1);
  write_text("a.face.csv", face_text("0.5"));
  ImportOptions mirrored;
  mirrored.motion.mirror = true;
  import_all(mirrored);
  const Motion before = Database(folder_ / "db", kv::Access::read_only).read("a");
  write_text("a.face.csv", face_text("0.25"));
  EXPECT_THAT(import_all({.replace_motion = true}), ElementsAre(ImportOutcome::motion_replaced));
  const Database database(folder_ / "db", kv::Access::read_only);
  EXPECT_TRUE(same_poses(database.read("a"), before));
  EXPECT_TRUE(database.info("a")->motion_facts.layout->mirrored);
  ASSERT_EQ(database.read("a").tracks().size(), 1u);
  EXPECT_EQ(database.read("a").tracks()[0].values[9], 0.25f);
}

TEST_F(ImportTest, AFaceBecomesTracksOfTheMotion) {
  write_motion("a.bvh", 1);  // 200 frames, 2 s
  write_text("a.face.csv", face_text("0.5"));
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::added));
  EXPECT_THAT(notices_, testing::Not(testing::Contains(HasSubstr("face"))));
  {
    const Database database(folder_ / "db", kv::Access::read_only);
    const Motion motion = database.read("a");
    ASSERT_EQ(motion.tracks().size(), 1u);
    EXPECT_EQ(motion.tracks()[0], (ScalarTrack{"jawOpen", std::vector<float>(200, 0.5f)}));
    EXPECT_EQ(database.info("a")->motion_facts.face_file, "a.face.csv");
    EXPECT_THAT(database.info("a")->motion->tracks, ElementsAre("jawOpen"));
  }
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::unchanged));
  std::filesystem::remove(files() / "a.face.csv");
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::unchanged))
      << "a missing face file does not remove the stored face";
  write_annotation("a.eaf", {"A"});
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::annotation_added));
  EXPECT_EQ(Database(folder_ / "db", kv::Access::read_only).read("a").tracks().size(), 1u);
}

TEST_F(ImportTest, AFirstFaceKeepsTheOptionsOfTheMotion) {
  write_motion("a.bvh", 1);
  ImportOptions mirrored;
  mirrored.motion.mirror = true;
  import_all(mirrored);
  const Motion before = Database(folder_ / "db", kv::Access::read_only).read("a");
  write_text("a.face.csv", face_text("0.5"));
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::face_added));
  const Database database(folder_ / "db", kv::Access::read_only);
  EXPECT_TRUE(same_poses(database.read("a"), before));
  EXPECT_EQ(database.read("a").tracks().size(), 1u);
  EXPECT_TRUE(database.info("a")->motion_facts.layout->mirrored);
}

TEST_F(ImportTest, AChangedFaceIsImportedOnlyOnRequest) {
  write_motion("a.bvh", 1);
  write_text("a.face.csv", face_text("0.5"));
  import_all();
  write_text("a.face.csv", face_text("0.25"));
  try {
    import_all();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::conflict);
    EXPECT_THAT(error.what(), HasSubstr("a.face.csv: is not the face that recording 'a' was imported with"));
  }
  EXPECT_EQ(Database(folder_ / "db", kv::Access::read_only).read("a").tracks()[0].values[9], 0.5f);
  EXPECT_THAT(import_all({.replace_motion = true}), ElementsAre(ImportOutcome::motion_replaced));
  EXPECT_EQ(Database(folder_ / "db", kv::Access::read_only).read("a").tracks()[0].values[9], 0.25f);
  std::filesystem::remove(files() / "a.face.csv");
  EXPECT_THAT(import_all({.replace_motion = true}), ElementsAre(ImportOutcome::motion_replaced));
  EXPECT_THAT(notices_, testing::Contains("was not given again, so its face is gone"));
  EXPECT_TRUE(Database(folder_ / "db", kv::Access::read_only).read("a").tracks().empty());
}

TEST_F(ImportTest, AFaceShorterOrLongerThanItsMotionIsReported) {
  write_motion("a.bvh", 1);
  write_text("a.face.csv", face_text("0.5", 60));
  write_motion("b.bvh", 2);
  write_text("b.face.csv", face_text("0.5", 240));
  import_all();
  EXPECT_THAT(notices_,
              testing::Contains(HasSubstr("the face ends 1.0 s before the motion; its last values are held")));
  EXPECT_THAT(notices_, testing::Contains(HasSubstr("the face continues 2.0 s after the motion; that is left out")));
}

TEST_F(ImportTest, ABrokenFacePreventsTheImportOfItsRecording) {
  write_motion("a.bvh", 1);
  write_text("a.face.csv", face_text("x"));
  try {
    import_all();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.face.csv:2: 'x' in column JawOpen is not a finite number"));
  }
  EXPECT_FALSE(Database(folder_ / "db", kv::Access::read_only).info("a"));
}

}  // namespace
}  // namespace signweave
