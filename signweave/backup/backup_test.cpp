#include "signweave/backup/backup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <set>
#include <thread>

#include "signweave/backup/part_file.h"
#include "signweave/backup/state_file.h"
#include "signweave/database/catalogue.h"
#include "signweave/database/check.h"
#include "signweave/database/test_recording.h"
#include "signweave/kv/test_child.h"
#include "signweave/kv/test_refusal.h"

namespace signweave {
namespace {

namespace fs = std::filesystem;
using namespace testing_database;
using kv::refusal_of;
using testing::ElementsAre;
using testing::HasSubstr;

/// All records of a database except the segment tables, which are rebuilt.
std::map<std::string, std::string> records_of(const fs::path& folder) {
  const std::unique_ptr<kv::KvStore> store = kv::open(folder, kv::Access::read_only);
  const std::unique_ptr<kv::ReadTransaction> snapshot = store->read();
  std::map<std::string, std::string> records;
  store->visit([&](ByteSpan key, std::size_t) {
    const char kind = static_cast<char>(key[0]);
    if (kind != 'I' && kind != 'L' && kind != 'C' && kind != 'P') {
      records.emplace(text_of(key), text_of(*snapshot->get(key)));
    }
  });
  return records;
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

/// Changes one byte of a file without changing its size.
void damage(const fs::path& path, std::streamoff at) {
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekg(at);
  const int byte = file.get();
  file.seekp(at);
  file.put(static_cast<char>(byte ^ 0x40));
}

class BackupTest : public testing::TestWithParam<std::string> {
 protected:
  BackupTest() {
    Database::create(path(), {.engine = GetParam()});
    Database database(path(), kv::Access::read_write);
    database.put(small_recording("a", 1, {"MATIN", "NUAGES"}));
    database.put(small_recording("b", 2, {"VANNES"}));
    database.put(small_recording("c", 3, {"PLUIE"}));
    database.learn();
  }
  fs::path path() const { return folder_ / "db"; }
  fs::path to() const { return folder_ / "backup"; }
  fs::path back() const { return folder_ / "back"; }
  fs::path part(std::string_view begin) const {
    for (const std::string& name : files_in(to() / "parts")) {
      if (name.starts_with(begin)) return to() / "parts" / name;
    }
    return {};
  }

  BackupReport back_up(const BackupOptions& options = {}) const {
    return backup(Database(path(), kv::Access::read_only), to(), options);
  }

  TestFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Engines, BackupTest, testing::ValuesIn(kv::engines()),
                         [](const auto& row) { return row.param; });

TEST_P(BackupTest, ARestoredDatabaseEqualsTheOriginal) {
  const BackupReport report = back_up();
  EXPECT_EQ(report.state, 1u);
  EXPECT_EQ(report.recordings, 3u);
  EXPECT_EQ(report.bytes_written, report.bytes);
  EXPECT_TRUE(check_backup(to()).empty());
  const RestoreReport restored = restore(to(), back());
  EXPECT_EQ(restored.recordings, 3u);
  EXPECT_EQ(records_of(back()), records_of(path()));
  const Database database(back(), kv::Access::read_only);
  EXPECT_EQ(database.engine().name, GetParam());
  EXPECT_TRUE(check(database).faults.empty());
  EXPECT_EQ(database.segments()->row_count(), Database(path(), kv::Access::read_only).segments()->row_count());
  EXPECT_EQ(files_in(folder_.path()), (std::set<std::string>{"back", "backup", "db"})) << "no other file is left";
}

TEST_P(BackupTest, ARestoredDatabaseAcceptsNewRecordings) {
  back_up();
  restore(to(), back());
  {
    Database database(back(), kv::Access::read_write);
    database.put(small_recording("d", 4, {"VANNES"}));
    database.remove("a");
  }
  const Database database(back(), kv::Access::read_only);
  EXPECT_TRUE(check(database).faults.empty());
  EXPECT_EQ(database.contents()->recordings.size(), 3u);
}

TEST_P(BackupTest, OnlyWhatChangedIsWritten) {
  const BackupReport first = back_up();
  const std::set<std::string> before = files_in(to() / "parts");
  const BackupReport same = back_up();
  EXPECT_FALSE(same.changed);
  EXPECT_EQ(same.state, 1u);
  EXPECT_EQ(same.bytes_written, 0u);
  {
    Database database(path(), kv::Access::read_write);
    database.put(small_recording("d", 4, {"SOLEIL"}));
  }
  const BackupReport more = back_up();
  EXPECT_EQ(more.state, 2u);
  EXPECT_LT(more.bytes_written, first.bytes / 2);
  std::set<std::string> added = files_in(to() / "parts");
  for (const std::string& name : before) EXPECT_EQ(added.erase(name), 1u) << "state 1 still uses it";
  EXPECT_EQ(added.size(), 3u) << "a motion, an annotation, a catalogue";
}

TEST_P(BackupTest, EveryStateCanBeRestored) {
  back_up();
  {
    Database database(path(), kv::Access::read_write);
    database.remove("b");
  }
  back_up();
  EXPECT_EQ(restore(to(), back()).recordings, 2u);
  EXPECT_EQ(restore(to(), folder_ / "older", {.state = 1}).recordings, 3u);
  EXPECT_TRUE(check(Database(folder_ / "older", kv::Access::read_only)).faults.empty());
  std::string text;
  EXPECT_EQ(refusal_of([&] { restore(to(), folder_ / "none", {.state = 7}); }, &text), ErrorCode::not_found);
  EXPECT_THAT(text, HasSubstr("no state 7; there are 1, 2"));
}

TEST_P(BackupTest, ARestoredAndChangedDatabaseHasItsOwnPartsInTheSameBackup) {
  back_up();
  {
    Database database(path(), kv::Access::read_write);
    database.put(small_recording("d", 4, {"SOLEIL"}));
  }
  back_up();
  restore(to(), back(), {.state = 1});
  {  // another motion under the same generation that "d" has in the other database
    Database database(back(), kv::Access::read_write);
    database.put(small_recording("e", 5, {"SOLEIL"}));
  }
  backup(Database(back(), kv::Access::read_only), to());
  restore(to(), folder_ / "d", {.state = 2});
  restore(to(), folder_ / "e", {.state = 3});
  EXPECT_TRUE(same_poses(Database(folder_ / "d", kv::Access::read_only).read("d"), small_motion(300, 4)));
  EXPECT_TRUE(same_poses(Database(folder_ / "e", kv::Access::read_only).read("e"), small_motion(300, 5)));
}

TEST_P(BackupTest, OldStatesAreRemovedWithTheirUnsharedParts) {
  back_up();
  for (int i = 0; i < 3; ++i) {
    {
      Database database(path(), kv::Access::read_write);
      database.put(small_recording("a", 10 + i, {"MATIN"}));
    }
    back_up({.keep = 2});
  }
  std::vector<std::uint64_t> numbers;
  for (const BackupState& state : backup_states(to())) numbers.push_back(state.number);
  EXPECT_THAT(numbers, ElementsAre(3, 4));
  EXPECT_EQ(files_in(to() / "parts").size(), 2u + 2u + 2u * 2u + 2u) << "b and c once, a and the catalogue twice";
  EXPECT_TRUE(check_backup(to()).empty());
}

TEST_P(BackupTest, ADamagedFileIsNamedAndItsRecordingMayBeSkipped) {
  back_up();
  damage(part("motion-"), 100);
  const std::vector<std::string> faults = check_backup(to());
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_THAT(faults[0], HasSubstr("its checksum does not fit; state 1 needs it"));
  std::string text;
  EXPECT_EQ(refusal_of([&] { restore(to(), back()); }, &text), ErrorCode::corrupt);
  EXPECT_THAT(text, HasSubstr("without its recording"));
  EXPECT_FALSE(fs::exists(back()));
  const RestoreReport rest = restore(to(), back(), {.skip_damaged = true});
  EXPECT_EQ(rest.recordings, 2u);
  ASSERT_EQ(rest.left_out.size(), 1u);
  EXPECT_THAT(rest.left_out[0], HasSubstr("left out: motion-"));
  EXPECT_TRUE(check(Database(back(), kv::Access::read_only)).faults.empty());
}

TEST_P(BackupTest, AMissingFileIsWrittenAgain) {
  back_up();
  fs::remove(part("annotation-"));
  ASSERT_EQ(check_backup(to()).size(), 1u);
  EXPECT_GT(back_up().bytes_written, 0u);
  EXPECT_TRUE(check_backup(to()).empty());
}

TEST_P(BackupTest, ADamagedCatalogueIsNotSkipped) {
  back_up();
  damage(part("catalogue-"), 60);
  std::string text;
  EXPECT_EQ(refusal_of([&] { restore(to(), back(), {.skip_damaged = true}); }, &text), ErrorCode::corrupt);
  EXPECT_THAT(text, HasSubstr("restore an older state"));
}

TEST_P(BackupTest, ADamagedRecordDoesNotReplaceAValidOne) {
  back_up();
  Bytes key;
  motion_db::for_each_key(*Database(path(), kv::Access::read_only).info("b")->motion,
                          [&](ByteSpan one) { key.assign(one.begin(), one.end()); });
  {
    const std::unique_ptr<kv::KvStore> store = kv::open(path(), kv::Access::read_write);
    const std::unique_ptr<kv::WriteTransaction> change = store->write();
    Bytes value;
    const ByteSpan stored = *change->get(key, value);
    Bytes copy(stored.begin(), stored.end());
    copy.back() ^= std::byte{1};
    change->put(key, copy);
    change->commit();
  }
  EXPECT_TRUE(back_up().faults.empty()) << "the backup contains the record that is damaged later";
  const fs::path elsewhere = folder_ / "elsewhere";
  const BackupReport report = backup(Database(path(), kv::Access::read_only), elsewhere);
  ASSERT_EQ(report.faults.size(), 1u);
  EXPECT_THAT(report.faults[0], HasSubstr("b: motion: a stored record is missing or damaged"));
  EXPECT_EQ(restore(elsewhere, back()).recordings, 2u);
  EXPECT_EQ(restore(to(), folder_ / "whole").recordings, 3u);
  EXPECT_TRUE(check(Database(folder_ / "whole", kv::Access::read_only)).faults.empty());
}

TEST_P(BackupTest, FoldersWithOtherContentAreRefused) {
  std::string text;
  fs::create_directory(folder_ / "mine");
  std::ofstream(folder_ / "mine" / "letter.txt") << "dear reader";
  const Database database(path(), kv::Access::read_only);
  EXPECT_EQ(refusal_of([&] { backup(database, folder_ / "mine"); }, &text), ErrorCode::bad_input);
  EXPECT_THAT(text, HasSubstr("neither a backup nor an empty folder"));
  EXPECT_EQ(refusal_of([&] { backup(database, path() / "inside"); }, &text), ErrorCode::bad_input);
  EXPECT_THAT(text, HasSubstr("is inside the database"));
  EXPECT_EQ(refusal_of([&] { restore(folder_ / "mine", back()); }, &text), ErrorCode::not_found);
  EXPECT_THAT(text, HasSubstr("not a signweave backup"));
  backup(database, to());
  EXPECT_EQ(refusal_of([&] { restore(to(), path()); }, &text), ErrorCode::already_exists);
}

TEST_P(BackupTest, ACancelledBackupLeavesTheStatesUnchanged) {
  back_up();
  {
    Database database(path(), kv::Access::read_write);
    database.put(small_recording("d", 4, {"SOLEIL"}));
  }
  const auto stop = [](double fraction) {
    if (fraction > 0.6) throw Error(ErrorCode::cancelled, "stopped");
  };
  EXPECT_EQ(refusal_of([&] { backup(Database(path(), kv::Access::read_only), to(), {}, stop); }), ErrorCode::cancelled);
  EXPECT_EQ(backup_states(to()).size(), 1u);
  EXPECT_EQ(refusal_of([&] { restore(to(), back(), {}, stop); }), ErrorCode::cancelled);
  EXPECT_EQ(files_in(folder_.path()), (std::set<std::string>{"backup", "db"}));
  EXPECT_EQ(back_up().state, 2u);
  EXPECT_EQ(restore(to(), back()).recordings, 4u);
}

TEST_P(BackupTest, ABackupDuringChangesIsConsistent) {
  // Written in pairs: a state has both of a pair or neither.
  Database database(path(), kv::Access::read_write);
  std::atomic<bool> stop = false;
  std::thread writer([&] {
    for (int i = 0; !stop; ++i) {
      database.put(small_recording("x", i, {"MATIN"}));
      database.put(small_recording("y", i, {"MATIN"}));
      if (i % 3 == 2) database.remove("y");
    }
  });
  const Database reader(path(), kv::Access::read_only);
  for (int round = 0; round < 5; ++round) {
    backup(reader, to(), {.keep = 3});
    EXPECT_TRUE(check_backup(to()).empty());
    const fs::path one = folder_ / fmt::format("round {}", round);
    const RestoreReport restored = restore(to(), one);
    const Database copy(one, kv::Access::read_only);
    EXPECT_TRUE(check(copy).faults.empty());
    EXPECT_EQ(restored.recordings, copy.contents()->recordings.size());
    if (copy.info("x") && copy.info("y")) {
      const int newer = std::stoi(copy.info("x")->signer.substr(1));
      const int older = std::stoi(copy.info("y")->signer.substr(1));
      EXPECT_TRUE(newer == older || newer == older + 1) << newer << " and " << older;
    }
  }
  stop = true;
  writer.join();
}

TEST_P(BackupTest, AKilledBackupLeavesTheStatesUnchanged) {
  back_up();
  for (int round = 0; round < 8; ++round) {
    {
      Database database(path(), kv::Access::read_write);
      database.put(small_recording("d", 20 + round, {"SOLEIL"}, 3000));
    }
    const pid_t child = ::fork();
    if (child == 0) {
      try {
        back_up({.keep = 2});
      } catch (const std::exception&) {
      }
      ::_exit(0);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(300 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_TRUE(check_backup(to()).empty());
  }
  back_up();
  restore(to(), back());
  EXPECT_EQ(records_of(back()), records_of(path()));
}

TEST_P(BackupTest, TheNextRestoreRemovesWhatAKilledOneLeft) {
  back_up();
  const fs::path left = folder_ / "back.999999999.part";
  fs::create_directory(left);
  std::ofstream(left / "data.mdb") << "half";
  restore(to(), back());
  EXPECT_FALSE(fs::exists(left));
}

TEST(BackupBetweenEngines, ABackupMayBeRestoredToAnotherEngine) {
  const TestFolder folder;
  Database::create(folder / "db", {});
  {
    Database database(folder / "db", kv::Access::read_write);
    database.put(small_recording("a", 1, {"MATIN", "NUAGES"}));
  }
  backup(Database(folder / "db", kv::Access::read_only), folder / "backup");
  for (const std::string& engine : kv::engines()) {
    restore(folder / "backup", folder / engine, {.engine = engine});
    EXPECT_EQ(records_of(folder / engine), records_of(folder / "db")) << engine;
    EXPECT_EQ(Database(folder / engine, kv::Access::read_only).engine().name, engine);
  }
}

}  // namespace
}  // namespace signweave
