#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <thread>

#include "signweave/kv/kv_store.h"
#include "signweave/kv/test_folder.h"

namespace signweave::kv {
namespace {

// Change number i puts kParts records that contain i, one of them large, replaces "last", and erases what change i -
// kKept put.
constexpr std::uint32_t kParts = 4;
constexpr std::uint32_t kKept = 20;

std::string key(std::uint32_t change, std::uint32_t part) {
  return "change " + std::to_string(change) + " part " + std::to_string(part);
}

std::string value(std::uint32_t change, std::uint32_t part) {
  const std::size_t size = part == 0 ? 20'000 + change % 7 * 9'000 : 50 + change % 300;
  return std::to_string(change) + std::string(size, static_cast<char>('a' + change % 26));
}

void apply(KvStore& store, std::uint32_t change) {
  const auto transaction = store.write();
  for (std::uint32_t part = 0; part < kParts; ++part) {
    transaction->put(bytes_of(key(change, part)), bytes_of(value(change, part)));
    if (change > kKept) transaction->erase(bytes_of(key(change - kKept, part)));
  }
  transaction->put(bytes_of("last"), bytes_of(std::to_string(change)));
  transaction->commit();
}

/// Applies changes in an endless loop, and acknowledges each through `acknowledge` once it is committed.
[[noreturn]] void write_until_killed(const std::filesystem::path& folder, std::uint32_t next, int acknowledge) {
  try {
    const auto store = open(folder, Access::read_write);
    for (;; ++next) {
      apply(*store, next);
      if (::write(acknowledge, &next, sizeof next) != sizeof next) break;
    }
  } catch (...) {
  }
  ::_exit(1);
}

/// Lets a child process write for `time`, kills it, and returns the last change that it acknowledged.
std::uint32_t write_and_kill(const std::filesystem::path& folder, std::uint32_t next, std::chrono::microseconds time) {
  int ends[2];
  if (::pipe(ends) != 0) return 0;
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    write_until_killed(folder, next, ends[1]);
  }
  ::close(ends[1]);
  std::uint32_t acknowledged = 0;
  std::uint32_t number = 0;
  EXPECT_EQ(::read(ends[0], &number, sizeof number), static_cast<ssize_t>(sizeof number)) << "the child works";
  acknowledged = number;
  std::this_thread::sleep_for(time);
  ::kill(child, SIGKILL);
  while (::read(ends[0], &number, sizeof number) == static_cast<ssize_t>(sizeof number)) acknowledged = number;
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the child was still writing";
  return acknowledged;
}

class CrashTest : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Engines, CrashTest, testing::ValuesIn(engines()), [](const auto& row) { return row.param; });

TEST_P(CrashTest, AfterKill9EveryAcknowledgedChangeIsStoredAndNoneIsPartial) {
  TestFolder folder;
  create(folder.path() / "db", GetParam());
  std::mt19937 random(7);
  std::uint32_t last = 0;
  for (int round = 0; round < 20; ++round) {
    const std::uint32_t acknowledged =
        write_and_kill(folder.path() / "db", last + 1, std::chrono::microseconds(random() % 60'000));
    ASSERT_GT(acknowledged, last);
    const auto store = open(folder.path() / "db", Access::read_write);
    const auto snapshot = store->read();
    last = static_cast<std::uint32_t>(std::stoul(std::string(text_of(snapshot->get(bytes_of("last")).value()))));
    ASSERT_GE(last, acknowledged);
    ASSERT_LE(last, acknowledged + 1) << "at most the one change that was in progress";
    for (std::uint32_t change = last > 2 * kKept ? last - 2 * kKept : 1; change <= last + 2; ++change) {
      const bool kept = change <= last && change + kKept > last;
      for (std::uint32_t part = 0; part < kParts; ++part) {
        const std::optional<ByteSpan> found = snapshot->get(bytes_of(key(change, part)));
        ASSERT_EQ(found.has_value(), kept) << key(change, part) << ", last " << last;
        if (found) {
          ASSERT_EQ(text_of(*found), value(change, part));
        }
      }
    }
  }
}

}  // namespace
}  // namespace signweave::kv
