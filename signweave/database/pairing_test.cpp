#include <gmock/gmock.h>

#include "signweave/database/test_import.h"

namespace signweave {
namespace {

using namespace testing_database;
using testing::ElementsAre;
using testing::HasSubstr;

class PairingTest : public ImportTest {
 protected:
  std::vector<std::string> paired(const std::vector<std::filesystem::path>& inputs,
                                  const std::optional<std::filesystem::path>& table = {}) {
    std::vector<std::string> result;
    for (const ImportJob& job : pair_files(inputs, table).jobs) {
      result.push_back(job.name + ": " + (job.motion ? job.motion->filename().string() : "-") + " " +
                       (job.annotation ? job.annotation->filename().string() : "-") +
                       (job.signer.empty() ? "" : " by " + job.signer));
    }
    return result;
  }
};

TEST_F(PairingTest, FilesPairByStemInAFolder) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"});
  write_motion("b.BVH", 2);
  write_annotation("c.eaf", {"C"});
  EXPECT_THAT(paired({files()}), ElementsAre("a: a.bvh a.eaf", "b: b.BVH -", "c: - c.eaf"));
}

TEST_F(PairingTest, AUniqueStemPairsAcrossFolders) {
  write_motion("motion/a.bvh", 1);
  write_annotation("annotation/a.eaf", {"A"});
  EXPECT_THAT(paired({files()}), ElementsAre("a: a.bvh a.eaf"));
}

TEST_F(PairingTest, StemsThatCollideKeepTheirFolder) {
  write_motion("x/a.bvh", 1);
  write_annotation("x/a.eaf", {"A"});
  write_motion("y/a.bvh", 2);
  write_annotation("y/a.eaf", {"A"});
  EXPECT_THAT(paired({files()}), ElementsAre("x/a: a.bvh a.eaf", "y/a: a.bvh a.eaf"));
}

TEST_F(PairingTest, OneAnnotationIsPairedWithAllMotionsThatItLinks) {
  write_motion("left cam.bvh", 1);
  write_motion("right.bvh", 2);
  write_annotation("session.eaf", {"A"},
                   {{.url = "file:///D:/data/left%20cam.bvh", .mime_type = "x", .media = false},
                    {.url = "right.bvh", .mime_type = "x", .media = false}});
  EXPECT_THAT(paired({files()}), ElementsAre("left cam: left cam.bvh session.eaf", "right: right.bvh session.eaf"));
}

TEST_F(PairingTest, ATableOfPairsTakesPrecedence) {
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

TEST_F(PairingTest, AFileOfAnotherKindIsRefusedAsInputAndPassedOverInAFolder) {
  write_motion("a.bvh", 1);
  write_text("notes.txt", "x");
  EXPECT_THROW(pair_files({files() / "notes.txt"}), Error);
  EXPECT_THROW(pair_files({files() / "none.bvh"}), Error);
  const Pairing pairing = pair_files({files()});
  ASSERT_EQ(pairing.notices.size(), 1u);
  EXPECT_THAT(pairing.notices[0].text, HasSubstr("1 file of other kinds"));
}

TEST_F(PairingTest, AFaceIsPairedOnlyWithTheMotionNextToIt) {
  write_motion("x/a.bvh", 1);
  write_motion("y/a.bvh", 2);
  write_motion("y/b.BVH", 3);
  write_text("y/a.face.csv", "x");
  write_text("y/b.Face.CSV", "x");
  write_text("y/c.face.csv", "x");
  write_text("y/a.csv", "x");
  const Pairing pairing = pair_files({files()});
  ASSERT_EQ(pairing.jobs.size(), 3u);
  EXPECT_FALSE(pairing.jobs[1].face) << pairing.jobs[1].name;
  EXPECT_EQ(pairing.jobs[2].name, "y/a");
  EXPECT_EQ(pairing.jobs[2].face, files() / "y/a.face.csv");
  EXPECT_EQ(pairing.jobs[0].face, files() / "y/b.Face.CSV");
  ASSERT_EQ(pairing.notices.size(), 2u);
  EXPECT_THAT(pairing.notices[0].text, HasSubstr("1 file of other kinds"));
  EXPECT_THAT(pairing.notices[1].where, HasSubstr("y/c.face.csv"));
  EXPECT_THAT(pairing.notices[1].text,
              HasSubstr("a face without its motion, passed over; put it next to the motion file 'c' (.bvh"));
}

TEST_F(PairingTest, AFaceIsPairedWithAMotionThatATablePairs) {
  write_motion("a.bvh", 1);
  write_annotation("b.eaf", {"B"});
  write_text("a.face.csv", face_text("0.5"));
  write_text("pairs.csv", "a.bvh,b.eaf\n");
  const Pairing pairing = pair_files({files() / "a.face.csv"}, files() / "pairs.csv");
  ASSERT_EQ(pairing.jobs.size(), 1u);
  EXPECT_EQ(pairing.jobs[0].face, files() / "a.face.csv");
}

TEST_F(PairingTest, ATableOfPairsExcludesAFaceAndGivesNames) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"});
  write_text("a.face.csv", face_text("0.5"));
  write_text("pairs.csv", "a.bvh,,,,-,,day 1/a\n,a.eaf\n");
  for (const std::vector<std::filesystem::path>& inputs : {std::vector<std::filesystem::path>{}, {files()}}) {
    const Pairing pairing = pair_files(inputs, files() / "pairs.csv");
    ASSERT_EQ(pairing.jobs.size(), 2u);
    EXPECT_EQ(pairing.jobs[0].name, "a");
    EXPECT_EQ(pairing.jobs[1].name, "day 1/a");
    EXPECT_FALSE(pairing.jobs[1].face);
  }
  EXPECT_EQ(pair_files({}, files() / "pairs.csv", true).jobs.size(), 2u);
  // A given name is used even if a recording of a shorter name exists.
  Database database(folder_ / "db", kv::Access::read_write);
  for (const ImportJob& job : pair_files({}, files() / "pairs.csv").jobs) import_recording(database, job, {});
  write_text("pairs.csv", ",a.eaf,,,,,day 1/a\n");
  EXPECT_EQ(import_recording(database, pair_files({}, files() / "pairs.csv").jobs.at(0), {}).outcome,
            ImportOutcome::annotation_added);
  write_text("pairs.csv", "a.bvh,,,,,,a\n,a.eaf,,,,,a\n");
  EXPECT_THROW(pair_files({}, files() / "pairs.csv"), Error);
  for (const char* row : {"../a.bvh,", "/etc/passwd,", "sub\\a.bvh,", "a.bvh,,,,../a.face.csv"}) {
    write_text("pairs.csv", row);
    try {
      pair_files({}, files() / "pairs.csv", true);
      FAIL() << row;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("the table may only name files next to it")) << row;
    }
  }
}

}  // namespace
}  // namespace signweave
