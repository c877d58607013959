// Joins, and the weights learned from the corpus: learning, storing, renewing and working without them.

#include "signweave/database/joins.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/database/check.h"
#include "signweave/database/test_signing.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {
namespace {

using namespace testing_database;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<std::string> kGlosses = {"A", "B", "C", "A", "B", "C", "B"};

struct Corpus {
  TestFolder folder;
  explicit Corpus(int recordings = 3, const std::string& engine = "lmdb") {
    Database::create(folder / "db", {.engine = engine});
    Database database(folder / "db", kv::Access::read_write);
    for (int i = 0; i < recordings; ++i) database.put(recording_of("r" + std::to_string(i), i, kGlosses));
  }
  Database open(kv::Access access = kv::Access::read_write) const { return Database(folder / "db", access); }

  void change_weights(const std::function<void(Bytes&)>& change) const {
    const auto store = kv::open(folder / "db", kv::Access::read_write);
    Bytes key;
    store->visit([&](ByteSpan one, std::size_t) {
      if (semantic_db::kind_of(one) == "weights") key.assign(one.begin(), one.end());
    });
    ASSERT_FALSE(key.empty()) << "nothing is stored";
    const auto transaction = store->write();
    const ByteSpan value = *transaction->get(key);
    Bytes changed(value.begin(), value.end());
    change(changed);
    transaction->put(key, changed);
    transaction->commit();
  }
};

TEST(Joins, MatchTheFeaturesOfTheStrokes) {
  const Corpus corpus;
  const Database database = corpus.open(kv::Access::read_only);
  const Snapshot snapshot = database.snapshot();
  const std::shared_ptr<const RecordingJoins> joins = snapshot.joins(1);
  EXPECT_EQ(joins, snapshot.joins(1)) << "read twice";
  ASSERT_EQ(joins->signs.size(), kGlosses.size());
  const RecordingFeatures features = database.features("r1");
  // Preparation, stroke, retraction of the first sign.
  EXPECT_EQ(joins->signs[0].begin.values, join_point(features.phases[1], true).values);
  EXPECT_EQ(joins->signs[0].end.values, join_point(features.phases[1], false).values);
  EXPECT_NE(joins->signs[0].begin.known, 0);
  EXPECT_FLOAT_EQ(joins->signs[0].stroke_seconds, 0.2f);
  EXPECT_EQ(joins->find(joins->signs[2].row), &joins->signs[2]);
  EXPECT_EQ(joins->find(kNoRow), nullptr);
}

TEST(Joins, NeighboursFollowEachOtherOnOneTier) {
  const Corpus corpus(2);
  const Database database = corpus.open(kv::Access::read_only);
  const Snapshot snapshot = database.snapshot();
  const Segments& table = snapshot.contents().segments;
  const std::shared_ptr<const RecordingJoins> joins = snapshot.joins(1);
  EXPECT_EQ(neighbour_before(table, joins->signs[0].row), kNoRow);
  EXPECT_EQ(neighbour_before(table, joins->signs[1].row), joins->signs[0].row);
  EXPECT_EQ(neighbour_after(table, joins->signs[1].row), joins->signs[2].row);
  EXPECT_EQ(neighbour_after(table, joins->signs.back().row), kNoRow);
}

TEST(Weights, LetRecordedNeighboursWin) {
  const TestFolder folder;
  Database::create(folder / "db", {});
  Database database(folder / "db", kv::Access::read_write);
  for (int i = 0; i < 6; ++i) {  // an arm that rises slowly, so that neighbouring signs resemble each other
    Recording recording = recording_of("r" + std::to_string(i), i, kGlosses);
    Motion& motion = recording.motion->motion;
    const auto arm = static_cast<std::size_t>(*motion.skeleton().find("RightArm"));
    for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
      const float angle = -0.8f + 0.1f * static_cast<float>(i) + 0.005f * static_cast<float>(frame);
      motion.pose(frame).rotations[arm] = Eigen::AngleAxisf(angle, Eigen::Vector3f::UnitZ());
    }
    database.put(recording);
  }
  const JoinWeights weights = database.snapshot().learned()->weights;
  EXPECT_EQ(weights.pairs, 6u * 6u);
  EXPECT_EQ(weights.folds, 5u);
  EXPECT_GT(weights.wins, 0.8f);
}

TEST(Weights, AreStoredOnceAndReadAgain) {
  for (const std::string& engine : kv::engines()) {
    SCOPED_TRACE(engine);
    const Corpus corpus(3, engine);
    JoinWeights learned;
    {
      Database database = corpus.open();
      learned = database.snapshot().learned()->weights;
      EXPECT_TRUE(database.learn());
      EXPECT_FALSE(database.learn());
      EXPECT_EQ(database.snapshot().learned()->weights, learned);
    }
    const Database database = corpus.open(kv::Access::read_only);
    EXPECT_EQ(database.snapshot().learned()->weights, learned);
    const std::vector<Usage> usage = database.usage();
    EXPECT_EQ(std::ranges::count(usage, "weights", &Usage::kind), 1);
    EXPECT_EQ(std::ranges::count(usage, "other", &Usage::kind), 0);
    EXPECT_THAT(check(database).faults, IsEmpty());
  }
}

TEST(Weights, FollowTheCurrentCorpus) {
  const Corpus corpus(3);
  Database database = corpus.open();
  database.learn();
  const JoinWeights three = database.snapshot().learned()->weights;
  database.put(recording_of("r3", 3, kGlosses));
  EXPECT_EQ(database.snapshot().learned()->weights.pairs, 4u * 6u) << "those of three recordings are still used";
  EXPECT_THAT(check(database).faults, IsEmpty());  // those of an older state are not used
  EXPECT_TRUE(database.learn());
  database.remove("r3");
  EXPECT_TRUE(database.learn());
  EXPECT_EQ(database.snapshot().learned()->weights, three);
  for (const char* name : {"r0", "r1", "r2"}) database.remove(name);
  EXPECT_TRUE(database.learn());
  EXPECT_EQ(database.snapshot().learned()->weights, JoinWeights{});
}

TEST(Weights, HoldUntilASixteenthOfTheChangesCameAfterThem) {
  const Corpus corpus(3);
  Database database = corpus.open();
  for (int i = 0; i < 18; ++i) {
    database.put(recording_of("r3", 3, kGlosses));
    database.remove("r3");
  }
  EXPECT_TRUE(database.learn());  // after 39 changes
  const JoinWeights three = database.snapshot().learned()->weights;
  database.put(recording_of("r3", 3, kGlosses));
  EXPECT_EQ(database.snapshot().learned()->weights, three);
  EXPECT_FALSE(database.learn());
  database.remove("r3");
  EXPECT_FALSE(database.learn());
  database.put(recording_of("r3", 3, kGlosses));  // the third of 42
  EXPECT_EQ(database.snapshot().learned()->weights.pairs, 4u * 6u);
  EXPECT_TRUE(database.learn());
  EXPECT_FALSE(database.learn());
}

TEST(Weights, ASnapshotUsesThoseOfItsOwnState) {
  const Corpus corpus(3);
  Database database = corpus.open();
  database.learn();
  const Snapshot before = database.snapshot();
  database.remove("r2");
  database.learn();
  EXPECT_EQ(before.learned()->weights.pairs, 3u * 6u);
  EXPECT_EQ(database.snapshot().learned()->weights.pairs, 2u * 6u);
}

TEST(Weights, DamagedOnesAreReportedAndLearnedAgain) {
  const Corpus corpus;
  JoinWeights learned;
  {
    Database database = corpus.open();
    database.learn();
    learned = database.snapshot().learned()->weights;
  }
  corpus.change_weights([](Bytes& bytes) { bytes[30] ^= std::byte{1}; });
  {
    const Database database = corpus.open(kv::Access::read_only);
    EXPECT_EQ(database.snapshot().learned()->weights, learned);
    EXPECT_THAT(check(database).faults, ElementsAre(HasSubstr("what was learned: the stored record is damaged")));
    EXPECT_THAT(check_in_child(corpus.folder / "db").faults, testing::SizeIs(1));
  }
  Database database = corpus.open();
  EXPECT_TRUE(database.learn()) << "learning repairs it";
  EXPECT_THAT(check(database).faults, IsEmpty());
}

TEST(Weights, ThoseThatDoNotMatchTheCorpusAreReported) {
  const Corpus corpus;
  {
    Database database = corpus.open();
    database.learn();
  }
  {
    const auto store = kv::open(corpus.folder / "db", kv::Access::read_write);
    const auto transaction = store->write();
    semantic_db::Learned stored = *semantic_db::read_learned(*transaction);
    stored.weights.weights[0] += 1;
    semantic_db::put_learned(*transaction, stored);
    transaction->commit();
  }
  EXPECT_THAT(check(corpus.open(kv::Access::read_only)).faults,
              ElementsAre(HasSubstr("does not match the recordings")));
}

TEST(Weights, OfRecordingsWithoutRigAreTheDefaults) {
  TestFolder folder;
  Database::create(folder / "db", {});
  Database database(folder / "db", kv::Access::read_write);
  database.put(small_recording("r", 1, {"A", "B", "A"}));
  EXPECT_EQ(database.snapshot().learned()->weights, JoinWeights{});
  const std::shared_ptr<const RecordingJoins> joins = database.snapshot().joins(0);
  EXPECT_FALSE(joins->why_not.empty());
  ASSERT_EQ(joins->signs.size(), 3u);
  EXPECT_EQ(joins->signs[0].begin.known, 0);
}

}  // namespace
}  // namespace signweave
