#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lmdb.h>
#include <unistd.h>

#include "signweave/kv/kv_store.h"
#include "signweave/kv/test_child.h"
#include "signweave/kv/test_folder.h"

/// Tests specific to LMDB: its file, its locks, its limits.
namespace signweave::kv {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(Lmdb, AFileThatLmdbItselfLeftShortCanBeOpened) {
  TestFolder folder;
  const fs::path path = folder.path() / "db";
  create(path, "lmdb");
  {
    const auto store = open(path, Access::read_write);
    fill(*store, 10);
    for (int i = 0; i < 3; ++i) {  // reusable pages make LMDB read its free list,
      const auto change = store->write();
      for (int k = 0; k < 20; ++k) change->erase(bytes_of("9/" + std::to_string(k)));
      change->put(bytes_of("note"), bytes_of("x"));
      change->commit();
    }
    const auto change = store->write();  // and then it immediately frees what was put and erased in one change
    change->put(bytes_of("note"), bytes_of("y"));
    change->put(bytes_of("large"), bytes_of(std::string(3'000'000, 'x')));
    change->erase(bytes_of("large"));
    change->commit();
  }
  MDB_env* env = nullptr;
  ASSERT_EQ(::mdb_env_create(&env), 0);
  ASSERT_EQ(::mdb_env_open(env, path.c_str(), MDB_RDONLY, 0), 0);
  MDB_envinfo info{};
  ::mdb_env_info(env, &info);
  ::mdb_env_close(env);
  ASSERT_LT(fs::file_size(path / "data.mdb"), (info.me_last_pgno + 1) * 4096) << "the case under test";

  const auto store = open(path, Access::read_write);
  read_everything(*store, 9);
  fill(*store, 12);
  read_everything(*store, 12);
}

TEST(Lmdb, AReadOnlyFolderIsReadableWithoutItsLockFile) {
  TestFolder folder;
  const fs::path path = folder.path() / "db";
  create(path, "lmdb");
  fill(*open(path, Access::read_write), 3);
  fs::remove(path / "lock.mdb");
  const ChildResult read = without_right_to_write(path, [&] { read_everything(*open(path, Access::read_only), 3); });
  EXPECT_TRUE(read.finished);
  EXPECT_EQ(read.text, "");
}

TEST(Lmdb, AChildProcessOpensItsOwnEnvironmentAndTheParentContinues) {
  TestFolder folder;
  const fs::path path = folder.path() / "db";
  create(path, "lmdb");
  const auto store = open(path, Access::read_write);
  fill(*store, 2);
  const auto snapshot = store->read();
  const ChildResult result = in_child([&] {
    const auto own = open(path, Access::read_write);
    read_everything(*own, 2);
    fill(*own, 4);
  });
  EXPECT_TRUE(result.finished);
  EXPECT_EQ(result.text, "");
  EXPECT_FALSE(snapshot->get(bytes_of("3/0")));
  read_everything(*store, 4);
  fill(*store, 6);
  read_everything(*store, 6);
}

TEST(Lmdb, ReopeningPreventsOtherProcessesFromReusingASnapshotsPages) {
  TestFolder folder;
  const fs::path path = folder.path() / "db";
  create(path, "lmdb");
  const auto store = open(path, Access::read_write);
  fill(*store, 5);
  const auto snapshot = store->read();
  open(path, Access::read_only).reset();  // a second environment would drop the process's lock now
  const ChildResult result = in_child([&] {
    const auto own = open(path, Access::read_write);
    for (int round = 0; round < 20; ++round) {
      const auto change = own->write();
      for (int i = 0; i < 5; ++i) {
        change->put(bytes_of(std::to_string(i) + "/0"), bytes_of(std::string(30'000, '#')));
      }
      change->commit();
    }
  });
  EXPECT_TRUE(result.finished);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(text_of(*snapshot->get(bytes_of(std::to_string(i) + "/0"))),
              std::string(30'000, static_cast<char>('a' + i)));
  }
}

TEST(Lmdb, TooManyReadersAreAnErrorAndThoseOfDeadProcessesAreDropped) {
  TestFolder folder;
  const fs::path path = folder.path() / "db";
  create(path, "lmdb");
  const auto store = open(path, Access::read_write);
  fill(*store, 1);
  std::vector<std::unique_ptr<ReadTransaction>> readers;
  try {
    while (readers.size() < 5'000) readers.push_back(store->read());
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::conflict);
    EXPECT_THAT(error.what(), HasSubstr("more than 1024 readers"));
  }
  EXPECT_EQ(readers.size(), 1024u);
  readers.clear();
  in_child([&] {  // ends while holding every reader slot
    const auto own = open(path, Access::read_only);
    std::vector<std::unique_ptr<ReadTransaction>> held;
    for (int i = 0; i < 1'024; ++i) held.push_back(own->read());
    ::_exit(0);
  });
  read_everything(*store, 1);
}

}  // namespace
}  // namespace signweave::kv
