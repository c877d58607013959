#include "signweave/kv/kv_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <functional>
#include <map>
#include <thread>

#include "signweave/kv/test_folder.h"
#include "signweave/kv/test_refusal.h"

namespace signweave::kv {
namespace {

using testing::HasSubstr;
using testing::Optional;

std::optional<std::string> text_at(const ReadTransaction& transaction, std::string_view key) {
  const std::optional<ByteSpan> value = transaction.get(bytes_of(key));
  if (!value) return std::nullopt;
  return std::string(text_of(*value));
}

void put(KvStore& store, std::string_view key, std::string_view value) {
  const auto change = store.write();
  change->put(bytes_of(key), bytes_of(value));
  change->commit();
}

/// Tests every rule of kv_store.h for every engine of this build.
class KvStoreTest : public testing::TestWithParam<std::string> {
 protected:
  KvStoreTest() {
    create(path(), GetParam());
    store_ = open(path(), Access::read_write);
  }
  std::filesystem::path path() const { return folder_.path() / "db"; }

  TestFolder folder_;
  std::unique_ptr<KvStore> store_;
};

INSTANTIATE_TEST_SUITE_P(Engines, KvStoreTest, testing::ValuesIn(engines()), [](const auto& row) { return row.param; });

TEST_P(KvStoreTest, CommittedChangesSurviveReopening) {
  put(*store_, "VANNES", "a city");
  store_.reset();
  store_ = open(path(), Access::read_only);
  EXPECT_THAT(text_at(*store_->read(), "VANNES"), Optional(std::string("a city")));
  EXPECT_EQ(text_at(*store_->read(), "BREST"), std::nullopt);
}

TEST_P(KvStoreTest, ASecondPutReplacesTheValue) {
  put(*store_, "k", std::string(10'000, 'a'));
  put(*store_, "k", "short");
  EXPECT_THAT(text_at(*store_->read(), "k"), Optional(std::string("short")));
  EXPECT_EQ(store_->info().entries, 1u);
}

TEST_P(KvStoreTest, ValuesOfEverySizeRoundTrip) {
  const std::size_t sizes[] = {0, 1, 100, 2'000, 4'079, 4'080, 4'081, 4'096, 8'176, 65'536, 3'000'000};
  const auto change = store_->write();
  for (const std::size_t size : sizes) {
    change->put(bytes_of(std::to_string(size)), bytes_of(std::string(size, static_cast<char>('a' + size % 26))));
  }
  change->commit();
  const auto snapshot = store_->read();
  for (const std::size_t size : sizes) {
    EXPECT_EQ(text_at(*snapshot, std::to_string(size)), std::string(size, static_cast<char>('a' + size % 26)));
  }
}

TEST_P(KvStoreTest, EraseReportsWhetherTheKeyExisted) {
  put(*store_, "k", "v");
  const auto change = store_->write();
  EXPECT_TRUE(change->erase(bytes_of("k")));
  EXPECT_FALSE(change->erase(bytes_of("k")));
  change->commit();
  EXPECT_EQ(text_at(*store_->read(), "k"), std::nullopt);
}

TEST_P(KvStoreTest, WithoutCommitNothingHappened) {
  put(*store_, "kept", "old");
  {
    const auto change = store_->write();
    change->put(bytes_of("kept"), bytes_of("new"));
    change->put(bytes_of("more"), bytes_of("x"));
    EXPECT_THAT(text_at(*change, "kept"), Optional(std::string("new"))) << "a change sees itself";
  }
  EXPECT_THAT(text_at(*store_->read(), "kept"), Optional(std::string("old")));
  EXPECT_EQ(text_at(*store_->read(), "more"), std::nullopt);
}

TEST_P(KvStoreTest, ASnapshotKeepsTheOldValueWhileAWriterCommits) {
  const std::string old_value(50'000, 'o');
  put(*store_, "k", old_value);
  const auto snapshot = store_->read();
  const std::optional<ByteSpan> lent = snapshot->get(bytes_of("k"));
  for (int i = 0; i < 20; ++i) put(*store_, "k", std::string(50'000, static_cast<char>('a' + i)));
  EXPECT_THAT(text_at(*snapshot, "k"), Optional(old_value));
  EXPECT_EQ(text_of(*lent), old_value) << "and bytes lent earlier stay valid";
  EXPECT_THAT(text_at(*store_->read(), "k"), Optional(std::string(50'000, 't')));
}

TEST_P(KvStoreTest, BytesLentByAWriteTransactionSurviveItsOwnPuts) {
  put(*store_, "small", "value");
  put(*store_, "large", std::string(9'000, 'l'));
  const auto change = store_->write();
  for (const char* key : {"a", "b", "c"}) change->put(bytes_of(key), bytes_of("first"));
  const std::optional<ByteSpan> own = change->get(bytes_of("b"));
  const std::optional<ByteSpan> small = change->get(bytes_of("small"));
  const std::optional<ByteSpan> large = change->get(bytes_of("large"));
  for (int i = 0; i < 200; ++i) change->put(bytes_of("key" + std::to_string(i)), bytes_of(std::string(100, 'x')));
  change->put(bytes_of("small"), bytes_of("other"));
  change->put(bytes_of("large"), bytes_of(std::string(9'000, 'm')));
  change->erase(bytes_of("a"));
  change->put(bytes_of("b"), bytes_of("other"));
  EXPECT_EQ(text_of(*own), "first");
  EXPECT_EQ(text_of(*small), "value");
  EXPECT_EQ(text_of(*large), std::string(9'000, 'l'));
}

TEST_P(KvStoreTest, ValuesReadIntoABufferEqualThoseLent) {
  for (int i = 0; i < 20; ++i) put(*store_, std::to_string(i), std::string(static_cast<std::size_t>(i) * 700, 'a'));
  const auto snapshot = store_->read();
  const auto change = store_->write();
  change->put(bytes_of("7"), bytes_of("changed"));
  Bytes buffer;
  for (int i = 19; i >= 0; --i) {
    const auto key = std::to_string(i);
    EXPECT_EQ(text_of(*snapshot->get(bytes_of(key), buffer)), text_of(*snapshot->get(bytes_of(key)))) << i;
    EXPECT_EQ(text_of(*change->get(bytes_of(key), buffer)), text_of(*change->get(bytes_of(key)))) << i;
  }
  EXPECT_EQ(snapshot->get(bytes_of("none"), buffer), std::nullopt);
}

TEST_P(KvStoreTest, AVisitSeesEveryEntryOnce) {
  std::map<std::string, std::size_t> expected;
  for (int i = 0; i < 300; ++i) {
    const std::string key = "key " + std::to_string(i);
    expected[key] = static_cast<std::size_t>(i) * 50;
    put(*store_, key, std::string(expected[key], 'x'));
  }
  std::map<std::string, std::size_t> seen;
  store_->visit(
      [&](ByteSpan key, std::size_t size) { EXPECT_TRUE(seen.emplace(text_of(key), size).second) << text_of(key); });
  EXPECT_EQ(seen, expected);
}

TEST_P(KvStoreTest, ASnapshotOutlivesItsStore) {
  put(*store_, "k", "v");
  const auto snapshot = store_->read();
  store_.reset();
  EXPECT_THAT(text_at(*snapshot, "k"), Optional(std::string("v")));
}

TEST_P(KvStoreTest, OneThreadMayHoldSeveralSnapshots) {
  std::vector<std::unique_ptr<ReadTransaction>> snapshots;
  for (int i = 0; i < 50; ++i) {
    put(*store_, "k", std::to_string(i));
    snapshots.push_back(store_->read());
  }
  for (std::size_t i = 0; i < snapshots.size(); ++i) {
    EXPECT_THAT(text_at(*snapshots[i], "k"), Optional(std::to_string(i)));
  }
}

TEST_P(KvStoreTest, AStoreOpenedTwiceIsOneStore) {
  const auto other = open(path(), Access::read_only);
  const auto linked = folder_.path() / "link";
  std::filesystem::create_directory_symlink(path(), linked);
  const auto third = open(linked, Access::read_write);
  put(*third, "k", "v");
  EXPECT_THAT(text_at(*other->read(), "k"), Optional(std::string("v")));
  store_.reset();
  put(*third, "k", "w");
  EXPECT_THAT(text_at(*other->read(), "k"), Optional(std::string("w")));
}

TEST_P(KvStoreTest, OpeningAndClosingInSeveralThreadsIsSafe) {
  put(*store_, "k", "v");
  store_.reset();
  std::atomic<int> seen = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      for (int round = 0; round < 50; ++round) {
        if (text_at(*open(path(), Access::read_only)->read(), "k") == "v") ++seen;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(seen, 200);
}

TEST_P(KvStoreTest, ReadersInSeveralThreadsNeverSeeHalfAChange) {
  put(*store_, "a", "0");
  put(*store_, "b", "0");
  std::atomic<bool> done = false;
  std::atomic<int> torn = 0;
  std::atomic<int> reads = 0;
  std::vector<std::thread> readers;
  for (int i = 0; i < 3; ++i) {
    readers.emplace_back([&] {
      do {
        const auto snapshot = store_->read();
        if (text_at(*snapshot, "a") != text_at(*snapshot, "b")) ++torn;
        ++reads;
      } while (!done);
    });
  }
  for (int i = 1; i <= 100; ++i) {
    const auto change = store_->write();
    change->put(bytes_of("a"), bytes_of(std::to_string(i)));
    change->put(bytes_of("b"), bytes_of(std::to_string(i)));
    change->commit();
  }
  done = true;
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(torn, 0);
  EXPECT_GT(reads, 0);
}

TEST_P(KvStoreTest, ASecondWriterWaitsForTheFirst) {
  std::vector<std::thread> writers;
  put(*store_, "count", "0");
  for (int i = 0; i < 4; ++i) {
    writers.emplace_back([&] {
      for (int round = 0; round < 25; ++round) {
        const auto change = store_->write();
        const int count = std::stoi(*text_at(*change, "count"));
        change->put(bytes_of("count"), bytes_of(std::to_string(count + 1)));
        change->commit();
      }
    });
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_THAT(text_at(*store_->read(), "count"), Optional(std::string("100")));
}

TEST_P(KvStoreTest, ANestedWriteOfOneThreadIsAnErrorNotADeadlock) {
  const auto change = store_->write();
  EXPECT_EQ(refusal_of([&] { store_->write(); }), ErrorCode::conflict);
}

TEST_P(KvStoreTest, AnotherThreadMayWriteAfterAnError) {
  { const auto change = store_->write(); }
  std::thread([&] { put(*store_, "k", "v"); }).join();
  put(*store_, "k", "w");
  EXPECT_THAT(text_at(*store_->read(), "k"), Optional(std::string("w")));
}

TEST_P(KvStoreTest, SpaceOfReplacedValuesIsReused) {
  for (int i = 0; i < 5; ++i) put(*store_, "k", std::string(1'000'000, 'x'));
  const auto size_once_closed = [&] {  // an engine may have logs while it is open
    store_.reset();
    store_ = open(path(), Access::read_write);
    return store_->info().bytes_on_disk;
  };
  const std::uint64_t before = size_once_closed();
  for (int i = 0; i < 50; ++i) put(*store_, "k", std::string(1'000'000, 'y'));
  EXPECT_LE(store_->info().bytes_on_disk, before + 40'000'000) << "and logs are bounded";
  EXPECT_LE(size_once_closed(), before + 2'000'000);
}

TEST_P(KvStoreTest, ManyBoundedTransactionsAddUp) {
  constexpr int kCommits = 40;
  constexpr int kPuts = 512;
  for (int i = 0; i < kCommits; ++i) {
    const auto change = store_->write();
    for (int k = 0; k < kPuts; ++k) {
      const std::string name = std::to_string(i * kPuts + k);
      change->put(bytes_of(name), bytes_of(name));
    }
    change->commit();
  }
  EXPECT_EQ(store_->info().entries, static_cast<std::uint64_t>(kCommits * kPuts));
  const auto snapshot = store_->read();
  for (int i = 0; i < kCommits * kPuts; i += 97) EXPECT_EQ(text_at(*snapshot, std::to_string(i)), std::to_string(i));
}

TEST_P(KvStoreTest, KeysHaveAMaximumLength) {
  const std::string longest(store_->longest_key(), 'k');
  put(*store_, longest, "v");
  EXPECT_THAT(text_at(*store_->read(), longest), Optional(std::string("v")));
  std::string text;
  EXPECT_EQ(refusal_of([&] { put(*store_, longest + "k", "v"); }, &text), ErrorCode::bad_input);
  EXPECT_THAT(text, HasSubstr("shorter name"));
  EXPECT_EQ(refusal_of([&] { store_->read()->get({}); }), ErrorCode::bad_input);
}

TEST_P(KvStoreTest, AReadOnlyStoreRefusesToWrite) {
  EXPECT_EQ(refusal_of([&] { open(path(), Access::read_only)->write(); }), ErrorCode::unsupported);
}

TEST_P(KvStoreTest, InfoReportsEngineEntriesAndSize) {
  put(*store_, "k", std::string(100'000, 'x'));
  const EngineInfo info = store_->info();
  EXPECT_EQ(info.name, GetParam());
  EXPECT_FALSE(info.version.empty());
  EXPECT_EQ(info.entries, 1u);
  EXPECT_GE(info.bytes_on_disk, 100'000u);
}

TEST_P(KvStoreTest, ANonEmptyFolderIsLeftUnchanged) {
  EXPECT_EQ(refusal_of([&] { create(path(), GetParam()); }), ErrorCode::already_exists);
  const auto other = folder_.path() / "notes";
  std::filesystem::create_directory(other);
  std::ofstream(other / "letter.txt") << "mine";
  EXPECT_EQ(refusal_of([&] { create(other, GetParam()); }), ErrorCode::already_exists);
  EXPECT_TRUE(std::filesystem::exists(other / "letter.txt"));
}

TEST_P(KvStoreTest, EmptyAndMissingFoldersBecomeStores) {
  const auto empty = folder_.path() / "empty";
  std::filesystem::create_directory(empty);
  create(empty, GetParam());
  EXPECT_EQ(open(empty, Access::read_only)->info().entries, 0u);
  create(folder_.path() / "a" / "b", GetParam());
  EXPECT_EQ(open(folder_.path() / "a" / "b", Access::read_only)->info().entries, 0u);
}

TEST(KvStore, AnUnknownEngineIsReportedWithTheKnownOnes) {
  ASSERT_FALSE(engines().empty());
  TestFolder folder;
  std::string text;
  EXPECT_EQ(refusal_of([&] { create(folder.path() / "db", "oracle"); }, &text), ErrorCode::unsupported);
  EXPECT_THAT(text, HasSubstr("no storage engine 'oracle'"));
  for (const std::string& name : engines()) EXPECT_THAT(text, HasSubstr(name));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "db"));
}

TEST(KvStore, AnEngineThatTheBuildLacksIsReported) {
  const std::pair<const char*, const char*> rows[] = {
      {"lmdb", "data.mdb"}, {"berkeley", "data.bdb"}, {"tokyo", "data.tch"}};
  for (const auto& [name, file] : rows) {
    const auto& engine = name;  // a lambda cannot capture a structured binding
    TestFolder folder;
    std::ofstream(folder / file) << "a store of that engine";
    std::string text;
    const ErrorCode code = refusal_of([&] { open(folder.path(), Access::read_only); }, &text);
    if (testing::Value(engines(), testing::Contains(name))) {
      EXPECT_EQ(code, ErrorCode::corrupt) << text;
      continue;
    }
    EXPECT_EQ(code, ErrorCode::unsupported);
    EXPECT_THAT(text, HasSubstr("its storage engine '" + std::string(name) + "' was left out of this build"));
    EXPECT_EQ(refusal_of([&] { create(folder.path() / "db", engine); }, &text), ErrorCode::unsupported);
    EXPECT_THAT(text, HasSubstr("left out of this build"));
  }
}

TEST(KvStore, AFolderWithoutStoreSaysHowToCreateOne) {
  TestFolder folder;
  for (const auto& path : {folder.path(), folder.path() / "nowhere"}) {
    std::string text;
    EXPECT_EQ(refusal_of([&] { open(path, Access::read_write); }, &text), ErrorCode::not_found);
    EXPECT_EQ(text, path.string() + ": no signweave database (make one with 'signweave create')");
  }
}

TEST(KvStore, AFileInsteadOfAFolderIsAnErrorThatNamesIt) {
  TestFolder folder;
  std::ofstream(folder.path() / "file") << "x";
  std::string text;
  EXPECT_EQ(refusal_of([&] { create(folder.path() / "file" / "db", engines().front()); }, &text), ErrorCode::io);
  EXPECT_THAT(text, HasSubstr("file"));
  EXPECT_EQ(refusal_of([&] { create(folder.path() / "file", engines().front()); }, &text), ErrorCode::io);
}

}  // namespace
}  // namespace signweave::kv
