// A database under faults: a full disk, flipped bits, concurrent processes.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <random>
#include <thread>

#include "signweave/core/error.h"
#include "signweave/database/check.h"
#include "signweave/database/test_recording.h"

namespace signweave {
namespace {

using namespace testing_database;
using testing::ElementsAre;

namespace fs = std::filesystem;

/// Starts a child process that runs `action`; an exception makes it fail.
pid_t begin_child(const std::function<void()>& action) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  int status = 0;
  try {
    action();
  } catch (const std::exception& error) {
    fmt::print(stderr, "in a child process: {}\n", error.what());
    status = 1;
  }
  ::_exit(status);
}

/// Waits for the child; true if it ended without a fault.
bool ended_well(pid_t child) {
  int status = -1;
  return child > 0 && ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void require(bool condition, const std::string& what) {
  if (!condition) throw std::runtime_error(what);
}

class DatabaseFaults : public testing::TestWithParam<std::string> {
 protected:
  DatabaseFaults() {
    Database::create(path(), {.engine = GetParam(), .access_mode = *parse_access_mode("by_frame:16")});
  }
  fs::path path() const { return folder_ / "db"; }
  TestFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Engines, DatabaseFaults, testing::ValuesIn(kv::engines()),
                         [](const auto& row) { return row.param; });

TEST_P(DatabaseFaults, AFullDiskIsAnErrorThatChangesNothing) {
  const Motion motion = small_motion(3'000, 1);
  std::uint64_t entries = 0;
  {
    Database database(path(), kv::Access::read_write);
    database.put(small_recording("a", 1, {"A"}, 3'000));
    entries = database.engine().entries;
  }
  const pid_t child = begin_child([&] {
    Database database(path(), kv::Access::read_write);
    ::signal(SIGXFSZ, SIG_IGN);
    std::uintmax_t largest = 0;
    for (const fs::directory_entry& file : fs::directory_iterator(path())) {
      largest = std::max(largest, file.is_regular_file() ? file.file_size() : 0);
    }
    const rlimit limit{largest + 200'000, largest + 200'000};  // simulates a full disk
    require(::setrlimit(RLIMIT_FSIZE, &limit) == 0, "no limit");
    const auto refused = [&](const char* what, const std::function<void()>& change) {
      try {
        change();
      } catch (const Error& error) {
        require(error.code() == ErrorCode::io, fmt::format("{}: {}", what, error.what()));
        return;
      }
      throw std::runtime_error(std::string(what) + " was not refused");
    };
    refused("adding", [&] { database.put(small_recording("b", 2, {"B"}, 300'000)); });
    refused("replacing", [&] { database.put(small_recording("a", 2, {"B"}, 300'000)); });
  });
  EXPECT_TRUE(ended_well(child));
  Database database(path(), kv::Access::read_write);
  EXPECT_EQ(database.contents()->recordings.size(), 1u);
  EXPECT_TRUE(same_poses(database.read("a"), motion));
  EXPECT_EQ(database.engine().entries, entries) << "nothing of the interrupted put is left";
  EXPECT_THAT(check(database).faults, ElementsAre());
  database.put(small_recording("b", 2, {"B"}, 100'000));
  EXPECT_TRUE(same_poses(database.read("b"), small_motion(100'000, 2)));
}

TEST_P(DatabaseFaults, AFlippedBitInAnyRecordIsAnErrorOrAnIntactAnswer) {
  std::vector<Bytes> keys;
  {
    Database database(path(), kv::Access::read_write);
    for (int i = 0; i < 3; ++i) {
      database.put(small_recording(fmt::format("r{}", i), i, {"A", "B"}, 40));
      database.relayout(fmt::format("r{}", i), {AccessMode{static_cast<AccessMode::Kind>(i + 1), 0}, {}});
    }
  }
  const auto store = kv::open(path(), kv::Access::read_write);
  store->visit([&](ByteSpan key, std::size_t) { keys.emplace_back(key.begin(), key.end()); });
  std::ranges::sort(keys);
  ASSERT_GE(keys.size(), 2u + 3 * 3 + 3);
  std::mt19937 random(5);
  for (const Bytes& key : keys) {
    const Bytes sound = [&] {
      const auto snapshot = store->read();
      const ByteSpan value = *snapshot->get(key);
      return Bytes(value.begin(), value.end());
    }();
    for (int round = 0; round < 12; ++round) {
      Bytes damaged = sound;
      damaged[random() % damaged.size()] ^= static_cast<std::byte>(1u << random() % 8);
      {
        const auto change = store->write();
        change->put(key, damaged);
        change->commit();
      }
      int intact = 0;
      bool reported = false;
      try {
        const Database database(path(), kv::Access::read_only);
        reported = !check(database).faults.empty();
        for (int i = 0; i < 3; ++i) {
          const std::string name = fmt::format("r{}", i);
          try {
            EXPECT_TRUE(same_poses(database.read(name), small_motion(40, i))) << "wrong motion";
            EXPECT_EQ(database.document(name).tiers, small_document({"A", "B"}).tiers);
            ++intact;
          } catch (const Error&) {
          }
        }
        EXPECT_GE(intact, 2) << "the others stay readable";
      } catch (const Error&) {  // without the head nothing can be checked
        reported = true;
        EXPECT_TRUE(key.size() == 1 && key[0] == std::byte{'C'});
      }
      EXPECT_TRUE(reported) << "check sees it";
    }
    const auto change = store->write();
    change->put(key, sound);
    change->commit();
  }
  EXPECT_THAT(check(Database(path(), kv::Access::read_only)).faults, ElementsAre());
}

TEST_P(DatabaseFaults, TwoWritersAndManyReadersInSeparateProcesses) {
  const auto opened = [&](kv::Access access) {  // another process has it open: try again, as the error says
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    for (;;) {
      try {
        return std::make_unique<Database>(path(), access);
      } catch (const Error& error) {
        if (error.code() != ErrorCode::conflict || std::chrono::steady_clock::now() > end) throw;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
  };
  constexpr int kPuts = 8;
  std::vector<pid_t> writers, readers;
  for (int writer = 0; writer < 2; ++writer) {
    writers.push_back(begin_child([&, writer] {
      for (int i = 0; i < kPuts; ++i) {
        opened(kv::Access::read_write)->put(small_recording(fmt::format("w{}", writer), 100 * writer + i, {"A"}, 500));
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    }));
  }
  for (int reader = 0; reader < 3; ++reader) {
    readers.push_back(begin_child([&] {
      for (int round = 0; round < 15; ++round) {
        const auto database = opened(kv::Access::read_only);
        const Snapshot snapshot = database->snapshot();
        for (const RecordingInfo& info : snapshot.contents().recordings) {
          const Motion motion = database->read(info.name);
          const int seed = static_cast<int>(std::lround(motion.pose(0).translations[0].x()));
          require(same_poses(motion, small_motion(500, seed)), info.name + " is not what a writer stored");
          require(seed / 100 == info.name[1] - '0', info.name + " belongs to the other writer");
        }
      }
    }));
  }
  for (const pid_t child : writers) EXPECT_TRUE(ended_well(child));
  for (const pid_t child : readers) EXPECT_TRUE(ended_well(child));
  const Database database(path(), kv::Access::read_only);
  for (int writer = 0; writer < 2; ++writer) {
    EXPECT_TRUE(same_poses(database.read(fmt::format("w{}", writer)), small_motion(500, 100 * writer + kPuts - 1)));
  }
  EXPECT_THAT(check(database).faults, ElementsAre());
}

}  // namespace
}  // namespace signweave
