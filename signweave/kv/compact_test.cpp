#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "signweave/kv/kv_store.h"
#include "signweave/kv/test_child.h"
#include "signweave/kv/test_folder.h"
#include "signweave/kv/test_refusal.h"

namespace signweave::kv {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class CompactTest : public testing::TestWithParam<std::string> {
 protected:
  CompactTest() { create(path(), GetParam()); }
  fs::path path() const { return folder_.path() / "db"; }

  /// Applies `changes` changes that stay, and as many that are erased again.
  void fill_with_gaps(int changes) const {
    const auto store = open(path(), Access::read_write);
    fill(*store, 2 * changes);
    for (int i = changes; i < 2 * changes; ++i) {
      const auto change = store->write();
      for (int k = 0; k < 20; ++k) change->erase(bytes_of(std::to_string(i) + '/' + std::to_string(k)));
      change->commit();
    }
  }

  TestFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Engines, CompactTest, testing::ValuesIn(engines()), [](const auto& row) { return row.param; });

TEST_P(CompactTest, FreesUnusedSpaceAndNothingElse) {
  fill_with_gaps(40);
  const std::optional<std::uint64_t> free = open(path(), Access::read_only)->info().bytes_free;
  const Compacted done = compact(path());
  EXPECT_LT(done.after, done.before * 7 / 10);
  if (free) EXPECT_NEAR(static_cast<double>(done.before - done.after), static_cast<double>(*free), 0.05 * 1.3e6);
  EXPECT_FALSE(fs::exists(path() / "compacting"));
  for (const fs::directory_entry& entry : fs::directory_iterator(path())) {
    const std::string name = entry.path().filename().string();
    EXPECT_FALSE(name.starts_with("log.") || name.ends_with(".wal")) << name << " belongs to the old file";
  }
  {
    const auto store = open(path(), Access::read_write);
    EXPECT_EQ(store->info().entries, 40u * 20u);
    read_everything(*store, 40);
    fill(*store, 60);  // the store remains usable
  }
  read_everything(*open(path(), Access::read_only), 60);
}

TEST_P(CompactTest, NothingIsFreeInAStoreThatWasJustCompacted) {
  fill_with_gaps(20);
  compact(path());
  const Compacted again = compact(path());
  EXPECT_NEAR(static_cast<double>(again.after), static_cast<double>(again.before),
              0.1 * static_cast<double>(again.before));
  if (const auto free = open(path(), Access::read_only)->info().bytes_free) EXPECT_LT(*free, 20'000u);
}

TEST_P(CompactTest, IsRefusedWhileThisProcessHasItOpen) {
  fill_with_gaps(5);
  std::string text;
  {
    const auto store = open(path(), Access::read_only);
    EXPECT_EQ(refusal_of([&] { compact(path()); }, &text), ErrorCode::conflict);
    EXPECT_THAT(text, HasSubstr("has it open"));
    read_everything(*store, 5);
  }
  EXPECT_NO_THROW(compact(path()));
}

TEST_P(CompactTest, IsRefusedWhileAnotherProcessReads) {
  fill_with_gaps(5);
  int ready[2], done[2];
  ASSERT_EQ(::pipe(ready), 0);
  ASSERT_EQ(::pipe(done), 0);
  const pid_t child = ::fork();
  char byte = 'x';
  if (child == 0) {
    ::close(done[1]);
    const auto store = open(path(), Access::read_only);
    if (::write(ready[1], &byte, 1) == 1 && ::read(done[0], &byte, 1) == 0) read_everything(*store, 5);
    ::_exit(0);
  }
  ::close(done[0]);
  EXPECT_EQ(::read(ready[0], &byte, 1), 1);
  std::string text;
  EXPECT_EQ(refusal_of([&] { compact(path()); }, &text), ErrorCode::conflict);
  EXPECT_THAT(text, HasSubstr("another process has it open"));
  ::close(done[1]);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_NO_THROW(compact(path()));
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST_P(CompactTest, ACancelledCompactionLeavesTheStoreUnchanged) {
  fill_with_gaps(30);
  const auto stop = [](double fraction) {
    if (fraction >= 0.5) throw Error(ErrorCode::cancelled, "stopped");
  };
  EXPECT_EQ(refusal_of([&] { compact(path(), stop); }), ErrorCode::cancelled);
  EXPECT_FALSE(fs::exists(path() / "compacting"));
  read_everything(*open(path(), Access::read_write), 30);
}

TEST_P(CompactTest, AKillAtAnyTimeLeavesTheOldOrTheNewFile) {
  fill_with_gaps(30);
  for (int round = 0; round < 12; ++round) {
    const pid_t child = ::fork();
    if (child == 0) {
      try {
        compact(path());
      } catch (const std::exception&) {
      }
      ::_exit(0);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(900 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const auto store = open(path(), Access::read_write);
    EXPECT_EQ(store->info().entries, 30u * 20u);
    read_everything(*store, 30);
  }
}

/// A process that opens the store during compaction waits, and then reads and changes the new file.
TEST_P(CompactTest, OpeningDuringCompactionGetsTheNewFileOrIsRefused) {
  fill_with_gaps(30);
  for (int round = 0; round < 6; ++round) {
    const pid_t child = ::fork();
    if (child == 0) {
      try {
        compact(path());
      } catch (const Error& error) {
        ::_exit(error.code() == ErrorCode::conflict ? 0 : 1);
      }
      ::_exit(0);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(500 * round));
    for (int i = 0;; ++i) {
      try {
        const auto store = open(path(), Access::read_write);
        read_everything(*store, 30);
        const auto change = store->write();
        change->put(bytes_of("round"), bytes_of(std::to_string(round)));
        change->commit();
        break;
      } catch (const Error& error) {
        ASSERT_EQ(error.code(), ErrorCode::conflict) << error.what();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    const auto snapshot = open(path(), Access::read_only)->read();
    EXPECT_EQ(text_of(*snapshot->get(bytes_of("round"))), std::to_string(round));
  }
}

TEST(Compact, AFolderWithoutStoreIsRefused) {
  const TestFolder folder;
  EXPECT_EQ(refusal_of([&] { compact(folder.path()); }), ErrorCode::not_found);
  EXPECT_FALSE(fs::exists(folder / "compacting"));
}

}  // namespace
}  // namespace signweave::kv
