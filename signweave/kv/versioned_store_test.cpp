#include "signweave/kv/versioned_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "signweave/kv/test_folder.h"

namespace signweave::kv {
namespace {

using testing::HasSubstr;
using testing::Optional;

/// An engine in memory that fails on request and calls the test before each step.
struct Fake {
  std::map<std::string, std::string> durable;
  std::function<void()> before_each_step = [] {};
  std::string fails_at;  ///< "put", "commit" or nothing
  bool breaks = false;   ///< a failure can only be repaired by reopening
  bool cannot_open = false;
  int opened = 0;
} fake;

class FakeStore final : public PlainStore {
 public:
  FakeStore() {
    if (fake.cannot_open) throw Error(ErrorCode::io, "no room to open");
    ++fake.opened;
    content_ = fake.durable;
  }
  std::optional<ByteSpan> get(ByteSpan key, Bytes& buffer) const override {
    if (text_of(key) == "slow") std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const auto at = content_.find(std::string(text_of(key)));
    if (at == content_.end()) return std::nullopt;
    make_room(buffer, at->second.size());
    std::copy_n(bytes_of(at->second).begin(), at->second.size(), buffer.begin());
    return ByteSpan(buffer).first(at->second.size());
  }
  bool has(ByteSpan key) const override { return content_.contains(std::string(text_of(key))); }
  std::uint64_t entries() const override { return content_.size(); }
  void visit(const std::function<void(ByteSpan, std::size_t)>& see) const override {
    for (const auto& [key, value] : content_) see(bytes_of(key), value.size());
  }
  void begin(std::size_t, std::uint64_t) override { fake.before_each_step(); }
  void put(ByteSpan key, ByteSpan value) override {
    if (content_.contains("half")) fail_at("put");
    content_[std::string(text_of(key))] = text_of(value);
  }
  void erase(ByteSpan key) override { content_.erase(std::string(text_of(key))); }
  void commit() override {
    fake.before_each_step();
    fail_at("commit");
    fake.durable = content_;
  }
  void abort() override { content_ = fake.durable; }
  bool sound() const noexcept override { return sound_; }
  void close() override {}

 private:
  void fail_at(const char* step) {
    if (fake.fails_at != step) return;
    sound_ = !fake.breaks;
    throw Error(ErrorCode::io, "the disk is full");
  }
  std::map<std::string, std::string> content_;
  bool sound_ = true;
};

constexpr PlainEngine kFake = {
    .name = "fake",
    .file = "data.fake",
    .version = [] { return std::string("1"); },
    .longest_key = 10,
    .largest_value = 1'000,
    .open = [](const std::filesystem::path&, Access, bool) -> std::unique_ptr<PlainStore> {
      return std::make_unique<FakeStore>();
    },
};

class VersionedStoreTest : public testing::Test {
 protected:
  VersionedStoreTest() {
    fake = {};
    std::ofstream(folder_ / "data.fake") << "x";
    store_ = open_versioned(folder_.path(), Access::read_write, kFake);
    put({{"a", "old"}, {"b", "old"}});
  }
  void put(const std::map<std::string, std::string>& values) const {
    const auto change = store_->write();
    for (const auto& [key, value] : values) change->put(bytes_of(key), bytes_of(value));
    change->commit();
  }
  static std::optional<std::string> at(const ReadTransaction& snapshot, std::string_view key) {
    const auto value = snapshot.get(bytes_of(key));
    if (!value) return std::nullopt;
    return std::string(text_of(*value));
  }
  static std::string all_of(const ReadTransaction& snapshot) {
    std::string text;
    for (const char* key : {"a", "b", "half", "z"}) text += at(snapshot, key).value_or("-") + ' ';
    return text;
  }

  TestFolder folder_;
  std::unique_ptr<KvStore> store_;
};

TEST_F(VersionedStoreTest, ASnapshotThatBeginsWhileAChangeIsAppliedSeesNothingOfItBeforeItIsDurable) {
  std::vector<std::unique_ptr<ReadTransaction>> begun;
  fake.before_each_step = [&] {  // before the first step, and when everything but the flush is done
    begun.push_back(store_->read());
    EXPECT_EQ(all_of(*begun.back()), "old old - - ");
  };
  {
    const auto change = store_->write();
    change->put(bytes_of("a"), bytes_of("new"));
    change->erase(bytes_of("b"));
    change->put(bytes_of("z"), bytes_of("new"));
    change->commit();
  }
  ASSERT_EQ(begun.size(), 2u);
  for (const auto& snapshot : begun) EXPECT_EQ(all_of(*snapshot), "old old - - ");
  EXPECT_EQ(all_of(*store_->read()), "new - - new ");
  begun.erase(begun.begin());
  EXPECT_EQ(all_of(*begun[0]), "old old - - ") << "the end of one snapshot does not affect another";
}

TEST_F(VersionedStoreTest, EachSnapshotSeesTheChangesBeforeIt) {
  std::vector<std::unique_ptr<ReadTransaction>> snapshots;
  for (int i = 0; i < 30; ++i) {
    if (i % 3 == 0) {
      const auto change = store_->write();
      change->erase(bytes_of("a"));
      change->commit();
    } else {
      put({{"a", std::to_string(i)}});
    }
    snapshots.push_back(store_->read());
  }
  for (const std::size_t gone : {4u, 0u, 17u}) snapshots[gone].reset();
  for (std::size_t i = 0; i < snapshots.size(); ++i) {
    if (!snapshots[i]) continue;
    EXPECT_EQ(at(*snapshots[i], "a"), i % 3 == 0 ? std::nullopt : std::optional(std::to_string(i))) << i;
  }
}

TEST_F(VersionedStoreTest, AFailureAtAnyStepLeavesTheOldStateAndTheNextChangeWorks) {
  for (const char* step : {"put", "commit"}) {
    for (const bool breaks : {false, true}) {
      fake.fails_at = step;
      fake.breaks = breaks;
      const int opened = fake.opened;
      const auto before = store_->read();
      EXPECT_THROW(put({{"a", "new"}, {"half", "new"}, {"z", "new"}}), Error);
      fake.fails_at.clear();
      EXPECT_EQ(fake.opened, opened + breaks) << step;
      EXPECT_EQ(all_of(*before), "old old - - ") << step;
      EXPECT_EQ(all_of(*store_->read()), "old old - - ") << step;
      put({{"z", "next"}});
      EXPECT_EQ(all_of(*store_->read()), "old old - next ") << step;
      EXPECT_EQ(all_of(*before), "old old - - ") << step;
      const auto change = store_->write();
      change->erase(bytes_of("z"));
      change->commit();
    }
  }
}

TEST_F(VersionedStoreTest, AChangeStoredByAFailedCommitIsNotSeenByOlderSnapshots) {
  const auto before = store_->read();
  fake.before_each_step = [] {
    fake.durable["a"] = "new";  // the change is on disk although the commit reports a failure
  };
  fake.fails_at = "commit";
  fake.breaks = true;
  EXPECT_THROW(put({{"a", "new"}}), Error);
  EXPECT_THAT(at(*before, "a"), Optional(std::string("old")));
  EXPECT_THAT(at(*store_->read(), "a"), Optional(std::string("new")));
}

TEST_F(VersionedStoreTest, AFailedReopeningIsReportedAndTriedAgain) {
  fake.fails_at = "commit";
  fake.breaks = fake.cannot_open = true;
  const auto before = store_->read();
  EXPECT_THROW(put({{"a", "new"}}), Error);
  fake.fails_at.clear();
  try {
    store_->read()->get(bytes_of("z"));
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::io);
    EXPECT_THAT(error.what(), HasSubstr("could not be reopened after a failure (no room to open)"));
  }
  fake.cannot_open = false;
  EXPECT_EQ(all_of(*store_->read()), "old old - - ");
  EXPECT_EQ(all_of(*before), "old old - - ");
  put({{"a", "next"}});
  EXPECT_EQ(all_of(*store_->read()), "next old - - ");
}

TEST_F(VersionedStoreTest, AVisitorMayReadAndWrite) {
  int seen = 0;
  store_->visit([&](ByteSpan key, std::size_t size) {
    EXPECT_EQ(size, 3u);
    EXPECT_TRUE(store_->read()->get(key));
    put({{"z", "new"}});
    ++seen;
  });
  EXPECT_EQ(seen, 2);
}

TEST_F(VersionedStoreTest, ReadersInALoopDoNotStarveTheWriter) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  std::atomic<bool> stop = false;
  std::vector<std::thread> readers;
  for (int i = 0; i < 8; ++i) {
    readers.emplace_back([&] {
      Bytes buffer;
      const auto snapshot = store_->read();
      while (!stop && std::chrono::steady_clock::now() < end) snapshot->get(bytes_of("slow"), buffer);
    });
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // at any moment some of them hold the lock
  std::map<std::string, std::string> many;
  for (int i = 0; i < 100; ++i) many[std::to_string(i)] = "x";
  put(many);
  EXPECT_LT(std::chrono::steady_clock::now(), end);
  stop = true;
  for (std::thread& reader : readers) reader.join();
}

TEST_F(VersionedStoreTest, ATooLargeValueIsRefusedByPut) {
  const auto change = store_->write();
  try {
    change->put(bytes_of("a"), bytes_of(std::string(1'001, 'x')));
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
    EXPECT_THAT(error.what(), HasSubstr("a value of 1001 bytes; this engine takes 1000 at most"));
  }
}

TEST(OldValues, AreStoredAsLongAsASnapshotNeedsThem) {
  OldValues old;
  old.keep(5, bytes_of("k"), bytes_of("four"));
  old.keep(5, bytes_of("other"), std::nullopt);
  old.keep(8, bytes_of("k"), bytes_of("five"));
  const auto text = [&](std::string_view key, std::uint64_t snapshot) -> std::string {
    const auto* const value = old.find(bytes_of(key), snapshot);
    if (!value) return "ask the store";
    return *value ? std::string(text_of(**value)) : "none";
  };
  EXPECT_EQ(text("k", 4), "four");
  EXPECT_EQ(text("k", 5), "five");
  EXPECT_EQ(text("k", 7), "five");
  EXPECT_EQ(text("k", 8), "ask the store");
  EXPECT_EQ(text("other", 4), "none");
  EXPECT_EQ(text("other", 5), "ask the store");
  EXPECT_EQ(old.forget(4).size(), 0u);
  EXPECT_EQ(old.forget(5).size(), 2u);
  EXPECT_EQ(text("k", 5), "five");
  EXPECT_EQ(old.forget(9).size(), 1u);
  EXPECT_TRUE(old.empty());
  EXPECT_EQ(text("k", 5), "ask the store");
}

}  // namespace
}  // namespace signweave::kv
