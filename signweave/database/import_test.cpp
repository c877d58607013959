#include "signweave/database/import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "signweave/core/atomic_file.h"
#include "signweave/database/test_recording.h"
#include "signweave/formats/eaf.h"
#include "signweave/query/parse.h"

namespace signweave {
namespace {

using namespace testing_database;
using testing::ElementsAre;
using testing::HasSubstr;

class ImportTest : public testing::Test {
 protected:
  ImportTest() {
    Database::create(folder_ / "db", {});
    std::filesystem::create_directories(files());
  }
  std::filesystem::path files() const { return folder_ / "files"; }

  void write_motion(const std::string& name, int seed, std::int64_t frames = 200) {
    const Motion motion = small_motion(frames, seed);
    std::filesystem::create_directories((files() / name).parent_path());
    bvh::write(files() / name, motion, bvh::default_layout(motion.skeleton()));
  }
  void write_annotation(const std::string& name, const std::vector<std::string>& glosses,
                        const std::vector<LinkedFile>& linked = {}) {
    AnnotationDocument document = small_document(glosses);
    document.linked_files = linked;
    std::filesystem::create_directories((files() / name).parent_path());
    eaf::write(files() / name, document);
  }
  void write_text(const std::string& name, const std::string& text) { std::ofstream(files() / name) << text; }

  std::vector<std::string> paired(const std::vector<std::filesystem::path>& inputs,
                                  std::optional<std::filesystem::path> table = {}) {
    std::vector<std::string> result;
    for (const ImportJob& job : pair_files(inputs, table).jobs) {
      result.push_back(job.name + ": " + (job.motion ? job.motion->filename().string() : "-") + " " +
                       (job.annotation ? job.annotation->filename().string() : "-") +
                       (job.signer.empty() ? "" : " by " + job.signer));
    }
    return result;
  }
  /// Imports everything and tells what became of it.
  std::vector<ImportOutcome> import_all(const ImportOptions& options = {}) {
    Database database(folder_ / "db", kv::Access::read_write);
    std::vector<ImportOutcome> outcomes;
    notices_.clear();
    for (const ImportJob& job : pair_files({files()}).jobs) {
      ImportReport report = import_recording(database, job, options);
      outcomes.push_back(report.outcome);
      for (const Notice& notice : report.notices) notices_.push_back(notice.text);
    }
    return outcomes;
  }
  TestFolder folder_;
  std::vector<std::string> notices_;
};

TEST_F(ImportTest, FilesPairByStemInAFolder) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"});
  write_motion("b.BVH", 2);
  write_annotation("c.eaf", {"C"});
  EXPECT_THAT(paired({files()}), ElementsAre("a: a.bvh a.eaf", "b: b.BVH -", "c: - c.eaf"));
}

TEST_F(ImportTest, AStemThatIsUniquePairsAcrossFolders) {
  write_motion("motion/a.bvh", 1);
  write_annotation("annotation/a.eaf", {"A"});
  EXPECT_THAT(paired({files()}), ElementsAre("a: a.bvh a.eaf"));
}

TEST_F(ImportTest, StemsThatCollideKeepTheirFolder) {
  write_motion("x/a.bvh", 1);
  write_annotation("x/a.eaf", {"A"});
  write_motion("y/a.bvh", 2);
  write_annotation("y/a.eaf", {"A"});
  EXPECT_THAT(paired({files()}), ElementsAre("x/a: a.bvh a.eaf", "y/a: a.bvh a.eaf"));
}

TEST_F(ImportTest, OneAnnotationServesTheMotionsThatItLinks) {
  write_motion("left cam.bvh", 1);
  write_motion("right.bvh", 2);
  write_annotation("session.eaf", {"A"},
                   {{.url = "file:///D:/data/left%20cam.bvh", .mime_type = "x", .media = false},
                    {.url = "right.bvh", .mime_type = "x", .media = false}});
  EXPECT_THAT(paired({files()}), ElementsAre("left cam: left cam.bvh session.eaf", "right: right.bvh session.eaf"));
}

TEST_F(ImportTest, ATableOfPairsDecides) {
  write_motion("a.bvh", 1);
  write_annotation("b.eaf", {"B"});
  write_text("pairs.csv", "motion,annotation,signer,offset\r\na.bvh,b.eaf,\"Dupont, Marie\",120\r\n");
  EXPECT_THAT(paired({files()}, files() / "pairs.csv"), ElementsAre("a: a.bvh b.eaf by Dupont, Marie"));
  write_text("wrong.csv", "a.bvh,b.eaf\na.bvh,none.eaf\n");
  try {
    pair_files({}, files() / "wrong.csv");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("wrong.csv:2: no file 'none.eaf'"));
  }
}

TEST_F(ImportTest, AFileOfAnotherKindIsRefusedByNameAndPassedOverInAFolder) {
  write_motion("a.bvh", 1);
  write_text("notes.txt", "x");
  EXPECT_THROW(pair_files({files() / "notes.txt"}), Error);
  EXPECT_THROW(pair_files({files() / "none.bvh"}), Error);
  const Pairing pairing = pair_files({files()});
  ASSERT_EQ(pairing.notices.size(), 1u);
  EXPECT_THAT(pairing.notices[0].text, HasSubstr("1 files of other kinds"));
}

TEST_F(ImportTest, ASecondImportDoesWhatChangedAndNoMore) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"});
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::added));
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::unchanged));
  write_annotation("a.eaf", {"B"});
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::annotation_replaced));
  EXPECT_EQ(Database(folder_ / "db", kv::Access::read_only).find(parse("gloss = \"B\"")).size(), 1u);
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::unchanged));
}

TEST_F(ImportTest, AMotionThatChangedIsTakenOnlyWhenAsked) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"});
  import_all();
  const Motion before = Database(folder_ / "db", kv::Access::read_only).read("a");
  write_motion("a.bvh", 2);
  try {
    import_all();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("--replace-motion"));
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

TEST_F(ImportTest, HalvesComeTogetherInAnyOrder) {
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

TEST_F(ImportTest, WhatAnEarlierImportWasToldHolds) {
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

TEST_F(ImportTest, WhatWasGuessedIsGuessedAgain) {
  write_motion("a.bvh", 1);
  AnnotationDocument document = small_document({"A"});
  document.tiers.pop_back();  // no phases yet
  eaf::write(files() / "a.eaf", document);
  import_all();
  write_annotation("a.eaf", {"A"});
  import_all();
  EXPECT_EQ(Database(folder_ / "db", kv::Access::read_only).find(parse("phase = preparation")).size(), 1u);
}

TEST_F(ImportTest, AnOffsetGivenWithTheAnnotationWaitsForTheMotion) {
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

TEST_F(ImportTest, ADamagedDocumentIsMendedByImportingItAgain) {
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
  EXPECT_FALSE(Database(folder_ / "db", kv::Access::read_only).check().empty());
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::annotation_replaced));
  EXPECT_TRUE(Database(folder_ / "db", kv::Access::read_only).check().empty());
}

TEST_F(ImportTest, AClockThatNoRecordingCanHaveIsRefused) {
  write_motion("a.bvh", 1);
  EXPECT_THROW(import_all({.offset = Seconds(std::nan(""))}), Error);
  EXPECT_THROW(import_all({.offset = Seconds(1e300)}), Error);
  EXPECT_THROW(import_all({.sync = {{0, Seconds(0)}, {1, Seconds(1000)}}}), Error);
}

TEST_F(ImportTest, ALinkedFileIsKnownByItsWholeName) {
  write_motion("sign.bvh", 1);
  write_annotation("sign.eaf", {"A"},
                   {{.url = "file:///x/othersign.bvh", .mime_type = "x", .time_origin = 700ms, .media = false},
                    {.url = "file:///x/s%69gn.bvh", .mime_type = "x", .time_origin = 200ms, .media = false}});
  import_all();
  EXPECT_NEAR(Database(folder_ / "db", kv::Access::read_only).info("sign")->clock.origin.count(), -0.2, 1e-9);
}

TEST_F(ImportTest, AStoredRecordingKeepsItsNameWhenAnotherOfItsStemComesBeside) {
  write_motion("a.bvh", 1);
  import_all();
  write_motion("sub/a.bvh", 2);
  EXPECT_THAT(import_all(), ElementsAre(ImportOutcome::unchanged, ImportOutcome::added));
  EXPECT_EQ(Database(folder_ / "db", kv::Access::read_only).contents()->recordings.size(), 2u);
}

TEST_F(ImportTest, ReplacingTheMotionMendsDamage) {
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

TEST_F(ImportTest, PhaseLabelsAreReadFromATable) {
  write_text("labels.txt", "# ours\nVorbereitung = preparation\n  Halten=stroke\n");
  const auto labels = read_phase_labels(files() / "labels.txt");
  EXPECT_EQ(labels.at("vorbereitung"), PhaseKind::preparation);
  EXPECT_EQ(labels.at("halten"), PhaseKind::stroke);
  write_text("wrong.txt", "\nA = B\n");
  EXPECT_THROW(read_phase_labels(files() / "wrong.txt"), Error);
}

}  // namespace
}  // namespace signweave
