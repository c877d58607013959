#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <random>
#include <thread>

#include "signweave/kv/kv_store.h"
#include "signweave/kv/test_child.h"
#include "signweave/kv/test_folder.h"

/// Tests specific to the hash engines. A build without the engine has nothing to test here.
namespace signweave::kv {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::vector<std::string> built(std::vector<std::string> names) {
  const std::vector<std::string> all = engines();
  std::erase_if(names, [&](const std::string& name) { return std::find(all.begin(), all.end(), name) == all.end(); });
  return names;
}

class BerkeleyTest : public testing::TestWithParam<std::string> {
 protected:
  BerkeleyTest() { create(path(), GetParam()); }
  fs::path path() const { return folder_.path() / "db"; }
  TestFolder folder_;
};
class TokyoTest : public BerkeleyTest {};

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(BerkeleyTest);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(TokyoTest);
INSTANTIATE_TEST_SUITE_P(Built, BerkeleyTest, testing::ValuesIn(built({"berkeley"})));
INSTANTIATE_TEST_SUITE_P(Built, TokyoTest, testing::ValuesIn(built({"tokyo"})));

void flip(const fs::path& file, std::uint64_t bit) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  char byte = 0;
  stream.seekg(static_cast<std::streamoff>(bit / 8));
  stream.get(byte);
  stream.seekp(static_cast<std::streamoff>(bit / 8));
  stream.put(static_cast<char>(byte ^ (1 << bit % 8)));
}

TEST_P(BerkeleyTest, AFlippedBitIsAnErrorOrHarmless) {
  fill(*open(path(), Access::read_write), 20);
  std::mt19937_64 random(5);
  int refused = 0;
  for (int round = 0; round < 60; ++round) {
    const fs::path copy = folder_ / "copy";
    fs::copy(path(), copy);
    const std::uint64_t bits = fs::file_size(copy / "data.bdb") * 8;
    flip(copy / "data.bdb", round < 20 ? random() % (4096 * 8) : random() % bits);
    const Access access = round % 2 == 0 ? Access::read_only : Access::read_write;
    const ChildResult result = in_child([&] { read_everything(*open(copy, access), 20); });
    EXPECT_TRUE(result.finished) << round;
    if (!result.text.empty()) {
      EXPECT_TRUE(result.code == ErrorCode::corrupt || result.code == ErrorCode::unsupported) << result.text;
      ++refused;
    }
    fs::remove_all(copy);
  }
  EXPECT_GT(refused, 20);
}

TEST_P(BerkeleyTest, ADamagedPageDoesNotAffectOthers) {
  fill(*open(path(), Access::read_write), 20);
  flip(path() / "data.bdb", (fs::file_size(path() / "data.bdb") - 5'000) * 8);
  for (const Access access : {Access::read_only, Access::read_write}) {
    const auto store = open(path(), access);
    int read = 0;
    int damaged = 0;
    const auto snapshot = store->read();
    for (int i = 0; i < 20; ++i) {
      try {
        if (snapshot->get(bytes_of(std::to_string(i) + "/0"))) ++read;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::corrupt);
        EXPECT_THAT(error.what(), HasSubstr("the store is damaged (")) << "with Berkeley DB's own message";
        EXPECT_THAT(error.what(), HasSubstr("restore it from a copy"));
        ++damaged;
      }
    }
    EXPECT_EQ(damaged, 1);
    EXPECT_EQ(read, 19);
  }
}

TEST_P(BerkeleyTest, AFileThatEndsWithinAPageIsRepairedIfTheWriterWasKilled) {
  fill(*open(path(), Access::read_write), 5);
  const std::uint64_t sound = fs::file_size(path() / "data.bdb");
  in_child([&] {
    const auto store = open(path(), Access::read_write);
    fill(*store, 8);
    ::_exit(1);
  });
  fs::resize_file(path() / "data.bdb",
                  fs::file_size(path() / "data.bdb") + 1'000);  // a write that reached the end of the disk
  read_everything(*open(path(), Access::read_write), 8);

  fs::resize_file(path() / "data.bdb", sound - 1'000);  // closed in order, then truncated
  try {
    open(path(), Access::read_write);
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::corrupt) << error.what();
    EXPECT_EQ(fs::file_size(path() / "data.bdb"), sound - 1'000) << "and it is left unchanged";
  }
}

TEST_P(BerkeleyTest, MissingLogsAreAnErrorOnlyIfNeeded) {
  const auto remove_logs = [&] {
    std::vector<fs::path> logs;
    for (const auto& entry : fs::directory_iterator(path())) {
      if (entry.path().filename().string().starts_with("log.")) logs.push_back(entry.path());
    }
    ASSERT_FALSE(logs.empty());
    for (const fs::path& log : logs) fs::remove(log);
  };
  fill(*open(path(), Access::read_write), 20);
  remove_logs();
  read_everything(*open(path(), Access::read_only), 20);
  fill(*open(path(), Access::read_write), 25);
  read_everything(*open(path(), Access::read_write), 25);
  in_child([&] {
    const auto store = open(path(), Access::read_write);
    fill(*store, 2);
    ::_exit(1);
  });
  remove_logs();
  for (int attempt = 0; attempt < 2; ++attempt) {
    try {
      open(path(), Access::read_write);
      FAIL() << "nothing was thrown";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::corrupt);
      EXPECT_THAT(error.what(), HasSubstr("its logs (log.…) are missing; restore it from a copy"));
    }
  }
}

TEST_P(BerkeleyTest, LogsStayBoundedAndOneIsLeftWhenClosed) {
  const auto logs = [&] {
    return std::count_if(fs::directory_iterator(path()), fs::directory_iterator(), [](const fs::directory_entry& file) {
      return file.path().filename().string().starts_with("log.");
    });
  };
  {
    const auto store = open(path(), Access::read_write);
    for (int i = 0; i < 100; ++i) {
      const auto change = store->write();
      change->put(bytes_of(std::to_string(i % 3)), bytes_of(std::string(1'000'000, static_cast<char>(i))));
      change->commit();
    }
    EXPECT_LE(logs(), 60);
  }
  EXPECT_EQ(logs(), 1);
}

/// Changes everything that `fill` put, and is killed meanwhile.
void die_while_changing(const fs::path& path, int changes) {
  const auto store = open(path, Access::read_write);
  const auto change = store->write();
  for (int i = 0; i < 10; ++i) change->put(bytes_of("new " + std::to_string(i)), bytes_of(std::string(5'000, '#')));
  for (int i = 0; i < changes; ++i) {
    for (int k = 0; k < 20; ++k) change->put(bytes_of(std::to_string(i) + '/' + std::to_string(k)), bytes_of("#"));
  }
  std::atomic<bool> done = false;
  std::thread killer([&] {  // once the log has some lines
    struct stat log {};
    while (!done && (::stat((path / "data.tch.wal").c_str(), &log) != 0 || log.st_size < 40'000)) {
    }
    ::kill(::getpid(), SIGKILL);
  });
  change->commit();
  done = true;
  killer.join();
}

TEST_P(TokyoTest, ALogWithATornLastLineIsStillUndone) {
  std::uint64_t size = 0;
  std::uint64_t entries = 0;
  for (int attempt = 0; attempt < 50 && size < 40'000; ++attempt) {  // the kill may come too late
    auto store = open(path(), Access::read_write);
    fill(*store, 20);
    entries = store->info().entries;
    store.reset();
    EXPECT_FALSE(in_child([&] { die_while_changing(path(), 20); }).finished);
    size = fs::file_size(path() / "data.tch.wal");
  }
  ASSERT_GE(size, 40'000u);
  // The head of a line of 65,792 bytes in either byte order, and some of its bytes.
  std::ofstream(path() / "data.tch.wal", std::ios::app | std::ios::binary)
      << std::string(9, '\0') + "\1\1" + '\0' + std::string(100, 'x');
  const auto store = open(path(), Access::read_write);
  read_everything(*store, 20);
  EXPECT_EQ(store->info().entries, entries);
  fill(*store, 25);
  read_everything(*store, 25);
}

}  // namespace
}  // namespace signweave::kv
