#include "signweave/database/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "signweave/database/test_recording.h"

namespace signweave {
namespace {

using namespace testing_database;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

namespace fs = std::filesystem;

/// A database of six recordings, one of them without annotation.
void make_database(const fs::path& folder, const std::string& engine) {
  Database::create(folder, {.engine = engine, .access_mode = *parse_access_mode("by_frame:16")});
  Database database(folder, kv::Access::read_write);
  for (int i = 0; i < 6; ++i) {
    Recording recording = small_recording("r" + std::to_string(i), i, {"A", "B"}, 400);
    if (i == 3) recording.annotation.reset();
    database.put(recording);
  }
}

class CheckTest : public testing::TestWithParam<std::string> {
 protected:
  CheckTest() { make_database(path(), GetParam()); }
  fs::path path() const { return folder_ / "db"; }
  TestFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Engines, CheckTest, testing::ValuesIn(kv::engines()),
                         [](const auto& row) { return row.param; });

TEST_P(CheckTest, ASoundDatabaseHasNoFault) {
  std::vector<double> seen;
  const CheckResult result = check_in_child(path(), [&](double fraction) { seen.push_back(fraction); });
  EXPECT_EQ(result.recordings, 6u);
  EXPECT_THAT(result.faults, ElementsAre());
  EXPECT_GE(seen.size(), 6u);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
}

TEST_P(CheckTest, AMissingDatabaseIsTheSameErrorAsWithoutAChild) {
  try {
    check_in_child(folder_ / "nowhere");
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_found);
    EXPECT_THAT(error.what(), HasSubstr("nowhere: no signweave database"));
  }
}

TEST_P(CheckTest, AChildReportsTheFaultsThatTheProgramItselfWouldReport) {
  {
    const auto store = kv::open(path(), kv::Access::read_write);
    std::vector<Bytes> packets;
    store->visit([&](ByteSpan key, std::size_t) {
      if (motion_db::kind_of(key) == "packets") packets.emplace_back(key.begin(), key.end());
    });
    std::ranges::sort(packets);
    const auto change = store->write();
    for (const std::size_t i : {3u, 60u}) {
      const ByteSpan value = *change->get(packets[i]);
      Bytes damaged(value.begin(), value.end());
      damaged[100] ^= std::byte{4};
      change->put(packets[i], damaged);
    }
    change->commit();
  }
  const std::vector<std::string> here = check(Database(path(), kv::Access::read_only)).faults;
  EXPECT_THAT(here, ElementsAre(AllOf(HasSubstr("r0: stored motion"), HasSubstr("all joints, frames [48, 64)")),
                                AllOf(HasSubstr("r2: stored motion"), HasSubstr("all joints, frames [160, 176)"))));
  EXPECT_EQ(check_in_child(path()).faults, here);
}

TEST(CheckLmdb, AMissingPageIsOneFaultOfOneRecording) {
  TestFolder folder;
  const fs::path file = folder / "db" / "data.mdb";
  Database::create(folder / "db", {.access_mode = {AccessMode::Kind::full, 0}});
  std::vector<Bytes> keys;
  {
    Database database(folder / "db", kv::Access::read_write);
    for (int i = 0; i < 3; ++i) database.put(small_recording("r" + std::to_string(i), i, {"A"}, 400));
    const std::uint64_t generation = database.info("r1")->motion->generation;
    kv::open(folder / "db", kv::Access::read_only)->visit([&](ByteSpan key, std::size_t) {
      if (motion_db::generation_of(key) == generation && motion_db::kind_of(key) == "packets") {
        keys.emplace_back(key.begin(), key.end());
      }
    });
  }
  ASSERT_EQ(keys.size(), 1u);
  // The value takes many pages; the number of the first follows its key.
  std::string bytes(fs::file_size(file), '\0');
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  const std::string_view key = text_of(keys[0]);
  int places = 0;
  for (std::size_t at = bytes.find(key); at != std::string::npos; at = bytes.find(key, at + 1), ++places) {
    stream.seekp(static_cast<std::streamoff>(at + key.size() + 5));
    stream.put(1);  // beyond page 2^40
  }
  stream.close();
  ASSERT_GT(places, 0);
  EXPECT_THAT(check_in_child(folder / "db").faults,
              ElementsAre(AllOf(HasSubstr("r1: stored motion"), HasSubstr("all joints, frames [0, 400): "),
                                HasSubstr("the store is damaged; restore it from a copy"))));
}

TEST(CheckLmdb, DamageToPagesIsReportedAndTheCheckContinuesAfterIt) {
  TestFolder folder;
  make_database(folder / "db", "lmdb");
  std::mt19937 random(3);
  const auto size = static_cast<std::streamoff>(fs::file_size(folder / "db" / "data.mdb"));
  int faulty = 0, deaths = 0;
  for (int round = 0; round < 40; ++round) {
    fs::remove_all(folder / "copy");
    fs::copy(folder / "db", folder / "copy");
    {  // many bytes, so that some rounds hit references to other pages; the first two pages are the file's head
      std::fstream file(folder / "copy" / "data.mdb", std::ios::in | std::ios::out | std::ios::binary);
      for (int i = 0; i < 60; ++i) {
        const std::streamoff page = 2 + static_cast<std::streamoff>(random()) % (size / 4096 - 2);
        file.seekp(page * 4096 + static_cast<std::streamoff>(random() % 64));
        file.put(static_cast<char>(random()));
      }
    }
    try {
      const CheckResult result = check_in_child(folder / "copy");
      faulty += result.faults.empty() ? 0 : 1;
      for (const std::string& fault : result.faults) {
        if (fault.find("the engine's own pages are damaged") != std::string::npos) ++deaths;
      }
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("copy"));
      ++faulty;
    }
  }
  EXPECT_GT(faulty, 35);
  EXPECT_GT(deaths, 0) << "no round killed a child: the test shows nothing";
}

}  // namespace
}  // namespace signweave
