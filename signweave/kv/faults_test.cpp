#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <fstream>

#include "signweave/kv/kv_store.h"
#include "signweave/kv/test_child.h"
#include "signweave/kv/test_folder.h"

/// Tests of damage, limits and kills: every engine must respond with a clear error or an intact answer.
namespace signweave::kv {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FaultsTest : public testing::TestWithParam<std::string> {
 protected:
  fs::path made(int changes) const {
    create(path(), GetParam());
    fill(*open(path(), Access::read_write), changes);
    return path();
  }
  fs::path path() const { return folder_.path() / "db"; }
  fs::path main_file() const {
    return path() / (GetParam() == "lmdb" ? "data.mdb" : GetParam() == "tokyo" ? "data.tch" : "data.bdb");
  }
  bool one_process() const { return GetParam() != "lmdb"; }  ///< serves one writer or several readers

  TestFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Engines, FaultsTest, testing::ValuesIn(engines()), [](const auto& row) { return row.param; });

TEST_P(FaultsTest, ATruncatedFileIsRefusedIfReadingItWouldCrash) {
  made(30);
  const auto size = fs::file_size(main_file());
  for (std::uint64_t cut = 0; cut < size; cut += size / 40) {
    const fs::path copy = folder_.path() / "cut";
    fs::copy(path(), copy);
    fs::resize_file(copy / main_file().filename(), cut);
    for (const Access access : {Access::read_only, Access::read_write}) {
      const ChildResult result = in_child([&] { read_everything(*open(copy, access), 30); });
      EXPECT_TRUE(result.finished) << "killed at " << cut << " of " << size;
      EXPECT_EQ(result.code, ErrorCode::corrupt) << cut << " of " << size << ": " << result.text;
      EXPECT_THAT(result.text, HasSubstr("restore it from a copy"));
    }
    fs::remove_all(copy);
  }
}

TEST_P(FaultsTest, AForeignFileIsCorruptAndDoesNotCrash) {
  for (const std::string& content : {std::string(), std::string("hello"), std::string(100'000, 'x')}) {
    for (const Access access : {Access::read_write, Access::read_only}) {
      fs::create_directories(path());
      std::ofstream(main_file()) << content;
      const ChildResult result = in_child([&] { open(path(), access); });
      EXPECT_TRUE(result.finished);
      EXPECT_EQ(result.code, ErrorCode::corrupt) << result.text;
      EXPECT_THAT(result.text, HasSubstr(main_file().string()));
      EXPECT_EQ(fs::file_size(main_file()), content.size()) << "and it was left unchanged";
      fs::remove_all(path());
    }
  }
}

TEST_P(FaultsTest, AFullDiskIsACleanErrorAndTheOldContentStays) {
  made(40);
  const ChildResult result = in_child([&] {
    const auto store = open(path(), Access::read_write);
    ::signal(SIGXFSZ, SIG_IGN);  // the limit simulates a full disk
    const rlim_t limit = fs::file_size(main_file()) + 100'000;
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
        require(std::string(error.what()).find("this change was not stored; ") != std::string::npos, error.what());
      }
      read_everything(*store, 40);
    }
    const auto change = store->write();
    change->put(bytes_of("small"), bytes_of("fits"));
    change->commit();
  });
  EXPECT_TRUE(result.finished);
  EXPECT_EQ(result.text, "");
  const auto store = open(path(), Access::read_write);
  read_everything(*store, 40);
  const auto snapshot = store->read();
  ASSERT_TRUE(snapshot->get(bytes_of("small")));
  std::uint64_t entries = 0;
  store->visit([&](ByteSpan, std::size_t) { ++entries; });
  EXPECT_EQ(store->info().entries, entries) << "a change that was refused does not count";
  EXPECT_EQ(text_of(*snapshot->get(bytes_of("small"))), "fits");
  fill(*store, 45);
  read_everything(*store, 45);
}

#ifndef SIGNWEAVE_SANITIZED  // sanitizers themselves need terabytes
TEST_P(FaultsTest, ASmallAddressSpaceSuffices) {
  made(3);
  const ChildResult result = in_child([&] {
    const rlim_t limit = rlim_t{4} << 30;
    const rlimit limits{limit, limit};
    require(::setrlimit(RLIMIT_AS, &limits) == 0, "setrlimit");
    const auto store = open(path(), Access::read_write);
    read_everything(*store, 3);
    fill(*store, 4);
  });
  EXPECT_TRUE(result.finished);
  EXPECT_EQ(result.text, "");
  read_everything(*open(path(), Access::read_only), 4);
}
#endif

TEST_P(FaultsTest, AReadOnlyFolderIsReadAndNotWritten) {
  made(3);
  const ChildResult read =
      without_right_to_write(path(), [&] { read_everything(*open(path(), Access::read_only), 3); });
  EXPECT_TRUE(read.finished);
  EXPECT_EQ(read.text, "");
  const ChildResult write = without_right_to_write(path(), [&] { open(path(), Access::read_write); });
  EXPECT_TRUE(write.finished);
  EXPECT_EQ(write.code, ErrorCode::io);
  EXPECT_THAT(write.text, HasSubstr(path().string() + ": no permission"));
}

TEST_P(FaultsTest, ACopyOfAClosedFolderIsABackup) {
  made(5);
  const fs::path copy = folder_.path() / "copy";
  fs::copy(path(), copy);
  fs::remove_all(path());
  read_everything(*open(copy, Access::read_only), 5);
  const auto store = open(copy, Access::read_write);
  fill(*store, 7);
  read_everything(*store, 7);
}

/// Ends the process without closing anything, as if killed.
[[noreturn]] void write_and_die(const fs::path& path, int changes) {
  const auto store = open(path, Access::read_write);
  fill(*store, changes);
  ::kill(::getpid(), SIGKILL);
  ::_exit(1);
}

TEST_P(FaultsTest, AReaderSeesTheCommitsOfAKilledWriter) {
  made(2);
  EXPECT_FALSE(in_child([&] { write_and_die(path(), 6); }).finished);
  read_everything(*open(path(), Access::read_only), 6);
}

TEST_P(FaultsTest, AfterAKilledWriterAReaderWithoutWritePermissionReadsOrGetsAClearError) {
  made(2);
  EXPECT_FALSE(in_child([&] { write_and_die(path(), 6); }).finished);
  const ChildResult read =
      without_right_to_write(path(), [&] { read_everything(*open(path(), Access::read_only), 6); });
  EXPECT_TRUE(read.finished);
  EXPECT_THAT(read.text, one_process()
                             ? HasSubstr("the last writer did not close the store; open it once with write permission")
                             : HasSubstr(""));
  EXPECT_EQ(read.text.empty(), !one_process());
  read_everything(*open(path(), Access::read_write), 6);
}

TEST_P(FaultsTest, AParentContinuesWhateverItsChildDoesWithInheritedStores) {
  made(2);
  auto store = open(path(), Access::read_write);
  const auto snapshot = store->read();
  in_child([&] {
    store.reset();  // closes nothing that belongs to the parent
  });
  const ChildResult result = in_child([&] { ::exit(0); });  // static objects are destroyed
  fill(*store, 4);
  read_everything(*store, 4);
  EXPECT_FALSE(snapshot->get(bytes_of("3/0")));
  store.reset();
  read_everything(*open(path(), Access::read_only), 4);
}

TEST_P(FaultsTest, SeveralProcessesRead) {
  made(3);
  const auto store = open(path(), Access::read_only);
  const ChildResult result = in_child([&] { read_everything(*open(path(), Access::read_only), 3); });
  EXPECT_TRUE(result.finished);
  EXPECT_EQ(result.text, "");
  read_everything(*store, 3);
}

TEST_P(FaultsTest, AWriterExcludesOthersIfTheEngineServesOneProcess) {
  made(3);
  const auto store = open(path(), Access::read_write);
  for (const Access access : {Access::read_only, Access::read_write}) {
    const ChildResult result = in_child([&] { read_everything(*open(path(), access), 3); });
    EXPECT_TRUE(result.finished);
    EXPECT_EQ(result.text.empty(), !one_process()) << result.text;
    if (!one_process()) continue;
    EXPECT_EQ(result.code, ErrorCode::conflict);
    EXPECT_THAT(result.text, HasSubstr("another process has it open"));
    EXPECT_THAT(result.text, HasSubstr("try again when it has finished"));
  }
  fill(*store, 4);
}

TEST_P(FaultsTest, AStoreOpenedReadOnlyIsWritableOnceAlsoOpenedForWriting) {
  made(3);
  const auto reader = open(path(), Access::read_only);
  const auto before = reader->read();
  const auto writer = open(path(), Access::read_write);
  fill(*writer, 5);
  read_everything(*reader, 5);
  EXPECT_FALSE(before->get(bytes_of("4/0")));
  EXPECT_TRUE(before->get(bytes_of("2/0")));
}

TEST_P(FaultsTest, AReaderCannotBecomeAWriterWhileAnotherProcessReads) {
  if (!one_process()) return;  // other engines never block a writer
  made(3);
  const auto reader = open(path(), Access::read_only);
  int ends[2], done[2];
  ASSERT_EQ(::pipe(ends), 0);
  ASSERT_EQ(::pipe(done), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const auto own = open(path(), Access::read_only);
    char go = 'r';
    ::_exit(::write(ends[1], &go, 1) == 1 && ::read(done[0], &go, 1) == 1 ? 0 : 1);
  }
  char go = 0;
  ASSERT_EQ(::read(ends[0], &go, 1), 1);
  EXPECT_THROW(open(path(), Access::read_write), Error);
  read_everything(*reader, 3);
  ASSERT_EQ(::write(done[1], &go, 1), 1);
  ::waitpid(child, nullptr, 0);
  fill(*open(path(), Access::read_write), 4);
  read_everything(*reader, 4);
  for (const int end : {ends[0], ends[1], done[0], done[1]}) ::close(end);
}

}  // namespace
}  // namespace signweave::kv
