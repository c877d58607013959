// Durations learned from the corpus: learning, storing, renewing and working without them. joins_test.cpp tests the
// weights.

#include "signweave/database/learn.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/database/check.h"
#include "signweave/database/test_signing.h"
#include "signweave/kv/sealed.h"

namespace signweave {
namespace {

using namespace testing_database;
using semantic_db::Learned;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Taught {
  TestFolder folder;
  Taught() {
    Database::create(folder / "db", {});
    Database database(folder / "db", kv::Access::read_write);
    for (int i = 0; i < 3; ++i) database.put(recording_of("r" + std::to_string(i), i, {"A", "B", "C", "A", "B"}));
    database.learn();
  }
  Database open() const { return Database(folder / "db", kv::Access::read_only); }
  Learned stored() const {
    const auto store = kv::open(folder / "db", kv::Access::read_only);
    return semantic_db::read_learned(*store->read()).value();
  }
  void store(const Learned& learned) const {
    const auto store = kv::open(folder / "db", kv::Access::read_write);
    const auto transaction = store->write();
    semantic_db::put_learned(*transaction, learned);
    transaction->commit();
  }
};

TEST(Learning, StoresHowLongTransitionsTake) {
  const Taught taught;
  const Learned stored = taught.stored();
  EXPECT_EQ(stored.durations.count, 3u * 4u);
  EXPECT_GT(stored.durations.mean, Seconds(0));
  EXPECT_EQ(stored.phased_signs, 3u * 5u);
  EXPECT_EQ(stored.unphased_signs, 0u);
  EXPECT_TRUE(nearly_same(stored, learn_from(taught.open().snapshot())));
}

TEST(Learning, IsNotRepeatedIfStored) {
  const Taught taught;
  Learned other = taught.stored();
  other.durations.mean = Seconds(0.75);  // not in the corpus, so it can only come from the store
  taught.store(other);
  EXPECT_EQ(taught.open().snapshot().learned()->durations.mean, Seconds(0.75));
}

TEST(Learning, DurationsThatDoNotMatchTheCorpusAreReported) {
  const Taught taught;
  EXPECT_THAT(check(taught.open()).faults, IsEmpty());
  Learned other = taught.stored();
  other.durations.mean += Seconds(0.1);
  taught.store(other);
  EXPECT_THAT(check(taught.open()).faults, ElementsAre(HasSubstr("does not match the recordings")));
  other = taught.stored();
  other.durations.mean -= Seconds(0.1);
  ++other.unphased_signs;
  taught.store(other);
  EXPECT_THAT(check(taught.open()).faults, ElementsAre(HasSubstr("does not match the recordings")));
}

TEST(Learning, ARecordOfTheVersionBeforeIsIgnored) {
  const Taught taught;
  const Learned now = taught.stored();
  ByteWriter before;  // weights alone
  before.number(std::uint16_t{1});
  before.number(now.changes);
  encode(now.weights, before);
  {
    const auto store = kv::open(taught.folder / "db", kv::Access::read_write);
    const auto transaction = store->write();
    transaction->put(semantic_db::learned_key(), kv::sealed(before.bytes()));
    transaction->commit();
  }
  EXPECT_TRUE(nearly_same(*taught.open().snapshot().learned(), now));
  EXPECT_THAT(check(taught.open()).faults, IsEmpty());
  EXPECT_TRUE(Database(taught.folder / "db", kv::Access::read_write).learn()) << "the next change stores it again";
  EXPECT_EQ(taught.stored().durations.count, now.durations.count);
}

}  // namespace
}  // namespace signweave
