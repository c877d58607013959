#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lmdb.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>

#include "signweave/kv/kv_store.h"
#include "signweave/kv/test_folder.h"

/// What is LMDB's own: its file, its locks, its limits.
namespace signweave::kv {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Runs `action` in a child process, and returns what it threw ("" where nothing was).
struct ChildResult {
  bool finished = false;  ///< false: killed by a signal
  ErrorCode code = ErrorCode::cancelled;
  std::string text;
};
ChildResult in_child(const std::function<void()>& action) {
  int ends[2];
  if (::pipe(ends) != 0) return {};
  const pid_t child = ::fork();
  if (child == 0) {
    std::string message;
    try {
      action();
    } catch (const Error& error) {
      message = static_cast<char>('0' + static_cast<int>(error.code())) + std::string(error.what());
    } catch (const std::exception& error) {
      message = std::string("?") + error.what();
    }
    ::_exit(::write(ends[1], message.data(), message.size()) == static_cast<ssize_t>(message.size()) ? 0 : 1);
  }
  ::close(ends[1]);
  ChildResult result;
  char buffer[1'000];
  for (ssize_t got; (got = ::read(ends[0], buffer, sizeof buffer)) > 0;) {
    result.text.append(buffer, static_cast<std::size_t>(got));
  }
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  result.finished = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (!result.text.empty()) {
    result.code = static_cast<ErrorCode>(result.text[0] - '0');
    result.text.erase(0, 1);
  }
  return result;
}

void require(bool condition, const char* what) {
  if (!condition) throw std::runtime_error(what);
}

void fill(KvStore& store, int changes) {
  for (int i = 0; i < changes; ++i) {
    const auto change = store.write();
    for (int k = 0; k < 20; ++k) {
      const std::string key = std::to_string(i) + '/' + std::to_string(k);
      change->put(bytes_of(key), bytes_of(std::string(k == 0 ? 30'000 : 150, static_cast<char>('a' + i % 26))));
    }
    change->commit();
  }
}

void read_everything(const KvStore& store, int changes) {
  const auto snapshot = store.read();
  for (int i = 0; i < changes; ++i) {
    for (int k = 0; k < 20; ++k) {
      const auto value = snapshot->get(bytes_of(std::to_string(i) + '/' + std::to_string(k)));
      require(value && value->back() == static_cast<std::byte>('a' + i % 26), "a value is wrong");
    }
  }
}

TEST(Lmdb, AFileCutShortIsRefusedWhereReadingItWouldKill) {
  TestFolder folder;
  create(folder.path() / "db", "lmdb");
  fill(*open(folder.path() / "db", Access::read_write), 30);
  const auto size = fs::file_size(folder.path() / "db" / "data.mdb");
  int refused = 0;
  for (std::uint64_t cut = 0; cut < size; cut += size / 40) {
    const fs::path copy = folder.path() / ("cut" + std::to_string(cut));
    fs::create_directory(copy);
    fs::copy_file(folder.path() / "db" / "data.mdb", copy / "data.mdb");
    fs::resize_file(copy / "data.mdb", cut);
    const ChildResult result = in_child([&] { read_everything(*open(copy, Access::read_only), 30); });
    EXPECT_TRUE(result.finished) << "killed at " << cut << " of " << size;
    EXPECT_EQ(result.code, ErrorCode::corrupt) << cut << " of " << size << ": " << result.text;
    EXPECT_THAT(result.text, HasSubstr("data.mdb: the file is cut short"));
    EXPECT_THAT(result.text, HasSubstr("restore it from a copy"));
    ++refused;
  }
  EXPECT_GT(refused, 30);
}

TEST(Lmdb, AFileThatLmdbItselfLeftShortIsOpened) {
  TestFolder folder;
  const fs::path path = folder.path() / "db";
  create(path, "lmdb");
  {
    const auto store = open(path, Access::read_write);
    fill(*store, 10);
    for (int i = 0; i < 3; ++i) {  // pages to use again make LMDB read its free list,
      const auto change = store->write();
      for (int k = 0; k < 20; ++k) change->erase(bytes_of("9/" + std::to_string(k)));
      change->put(bytes_of("note"), bytes_of("x"));
      change->commit();
    }
    const auto change = store->write();  // and then it drops at once what was put and erased in one change
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
  ASSERT_LT(fs::file_size(path / "data.mdb"), (info.me_last_pgno + 1) * 4096) << "the case that this test is about";

  const auto store = open(path, Access::read_write);
  read_everything(*store, 9);
  fill(*store, 12);
  read_everything(*store, 12);
}

TEST(Lmdb, AFileOfSomethingElseIsCorruptNotCrashing) {
  TestFolder folder;
  const fs::path path = folder.path() / "db";
  for (const std::string& content : {std::string(), std::string("hello"), std::string(100'000, 'x')}) {
    fs::create_directories(path);
    std::ofstream(path / "data.mdb") << content;
    const ChildResult result = in_child([&] { open(path, Access::read_write); });
    EXPECT_TRUE(result.finished);
    EXPECT_EQ(result.code, ErrorCode::corrupt) << result.text;
    EXPECT_THAT(result.text, HasSubstr((path / "data.mdb").string()));
    EXPECT_EQ(fs::file_size(path / "data.mdb"), content.size()) << "and it was left as it is";
    fs::remove_all(path);
  }
}

TEST(Lmdb, ADiskThatIsFullIsACleanErrorAndTheOldContentStays) {
  TestFolder folder;
  const fs::path path = folder.path() / "db";
  create(path, "lmdb");
  fill(*open(path, Access::read_write), 5);
  const ChildResult result = in_child([&] {
    const auto store = open(path, Access::read_write);
    ::signal(SIGXFSZ, SIG_IGN);  // the limit stands for the disk's end
    const rlim_t limit = fs::file_size(path / "data.mdb") + 100'000;
    const rlimit limits{limit, limit};
    require(::setrlimit(RLIMIT_FSIZE, &limits) == 0, "setrlimit");
    for (int attempt = 0; attempt < 2; ++attempt) {
      try {
        const auto change = store->write();
        change->put(bytes_of("0/0"), bytes_of(std::string(1'000'000, 'z')));
        change->commit();
        require(false, "nothing was thrown");
      } catch (const Error& error) {
        require(error.code() == ErrorCode::io, error.what());
        require(std::string(error.what()).find(path.string() + ": disk full") == 0, error.what());
      }
      read_everything(*store, 5);
    }
    const auto change = store->write();
    change->put(bytes_of("small"), bytes_of("fits"));
    change->commit();
  });
  EXPECT_TRUE(result.finished);
  EXPECT_EQ(result.text, "");
  const auto store = open(path, Access::read_write);
  read_everything(*store, 5);
  EXPECT_EQ(text_of(*store->read()->get(bytes_of("small"))), "fits");
  fill(*store, 8);
  read_everything(*store, 8);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they need terabytes themselves
TEST(Lmdb, ASmallAddressSpaceIsMadeDoWith) {
  TestFolder folder;
  const fs::path path = folder.path() / "db";
  create(path, "lmdb");
  fill(*open(path, Access::read_write), 3);
  const ChildResult result = in_child([&] {
    const rlim_t limit = rlim_t{4} << 30;
    const rlimit limits{limit, limit};
    require(::setrlimit(RLIMIT_AS, &limits) == 0, "setrlimit");
    const auto store = open(path, Access::read_write);
    read_everything(*store, 3);
    fill(*store, 4);
  });
  EXPECT_TRUE(result.finished);
  EXPECT_EQ(result.text, "");
  read_everything(*open(path, Access::read_only), 4);
}
#endif

TEST(Lmdb, AFolderWithoutRightToWriteIsReadAndNotWritten) {
  TestFolder folder;
  const fs::path path = folder.path() / "db";
  create(path, "lmdb");
  fill(*open(path, Access::read_write), 3);
  fs::permissions(folder.path(), fs::perms(0755));
  for (const bool lock_file : {true, false}) {
    if (!lock_file) fs::remove(path / "lock.mdb");
    for (const auto& entry : fs::directory_iterator(path)) fs::permissions(entry.path(), fs::perms(0444));
    fs::permissions(path, fs::perms(0555));
    const auto as_nobody = [&](Access access) {
      return in_child([&] {
        if (::geteuid() == 0) require(::setgid(65'534) == 0 && ::setuid(65'534) == 0, "become nobody");
        read_everything(*open(path, access), 3);
      });
    };
    const ChildResult read = as_nobody(Access::read_only);
    EXPECT_TRUE(read.finished);
    EXPECT_EQ(read.text, "");
    const ChildResult write = as_nobody(Access::read_write);
    EXPECT_TRUE(write.finished);
    EXPECT_EQ(write.code, ErrorCode::io);
    EXPECT_THAT(write.text, HasSubstr(path.string() + ": no permission"));
    fs::permissions(path, fs::perms(0755));
  }
}

TEST(Lmdb, AChildProcessOpensItsOwnAndTheParentGoesOn) {
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

TEST(Lmdb, OpeningAndClosingAgainKeepsOtherProcessesFromASnapshotsPages) {
  TestFolder folder;
  const fs::path path = folder.path() / "db";
  create(path, "lmdb");
  const auto store = open(path, Access::read_write);
  fill(*store, 5);
  const auto snapshot = store->read();
  open(path, Access::read_only).reset();  // a second environment would now drop the process's lock
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

TEST(Lmdb, TooManyReadersAreToldSoAndThoseOfTheDeadAreForgotten) {
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
  in_child([&] {  // dies holding every place
    const auto own = open(path, Access::read_only);
    std::vector<std::unique_ptr<ReadTransaction>> held;
    for (int i = 0; i < 1'024; ++i) held.push_back(own->read());
    ::_exit(0);
  });
  read_everything(*store, 1);
}

}  // namespace
}  // namespace signweave::kv
