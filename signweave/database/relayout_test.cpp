#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <thread>

#include "signweave/database/check.h"
#include "signweave/database/test_recording.h"
#include "signweave/motion_db/quantise.h"

namespace signweave {
namespace {

using namespace testing_database;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kModes[] = {"full", "by_frame:16", "by_frame", "by_joint", "by_joint_and_frame:7"};

/// Includes faces, since they are stored in separate records.
Recording with_face(const std::string& name, int seed) {
  Recording recording = small_recording(name, seed, {"A", "B"});
  ScalarTrack track{.name = "jawOpen", .values = {}};
  for (int i = 0; i < 300; ++i) track.values.push_back(0.001f * static_cast<float>(i + seed));
  recording.motion->motion.add_track(std::move(track));
  return recording;
}

std::uint64_t bytes_of_packets(const Database& database) {
  for (const Usage& one : database.usage()) {
    if (one.kind == "packets") return one.bytes;
  }
  return 0;
}

class RelayoutTest : public testing::TestWithParam<std::string> {
 protected:
  RelayoutTest() { Database::create(path(), {.engine = GetParam(), .access_mode = *parse_access_mode("by_frame:32")}); }
  std::filesystem::path path() const { return folder_ / "db"; }
  TestFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Engines, RelayoutTest, testing::ValuesIn(kv::engines()),
                         [](const auto& row) { return row.param; });

TEST_P(RelayoutTest, EveryChangeOfModeKeepsEveryBit) {
  Database database(path(), kv::Access::read_write);
  database.put(with_face("a", 1));
  database.put(with_face("b", 2));
  const RecordingInfo before = *database.info("a");
  const std::uint64_t others = database.engine().entries - motion_db::packet_count(*before.motion);
  for (const char* from : kModes) {
    for (const char* to : kModes) {
      database.relayout("a", {*parse_access_mode(from), {}});
      database.relayout("a", {*parse_access_mode(to), {}});
      const RecordingInfo info = *database.info("a");
      const AccessMode mode = info.motion->mode;
      EXPECT_EQ(mode, motion_db::fitted(*parse_access_mode(to), *database.skeleton("a"))) << to;
      EXPECT_TRUE(same_bits(database.read("a"), with_face("a", 1).motion->motion)) << from << " to " << to;
      EXPECT_EQ(database.engine().entries, others + motion_db::packet_count(*info.motion)) << "nothing is left behind";
    }
  }
  EXPECT_EQ(database.info("b")->motion, database.info("b")->motion);
  EXPECT_EQ(to_string(database.info("b")->motion->mode), "by_frame:32") << "recordings may differ in mode";
  RecordingInfo after = *database.info("a");
  after.motion = before.motion;
  EXPECT_EQ(after.document, before.document);
  EXPECT_EQ(after.motion_facts.fingerprint, before.motion_facts.fingerprint);
  EXPECT_THAT(check(database).faults, ElementsAre());
}

TEST_P(RelayoutTest, TheSecondTimeItDoesNothing) {
  Database database(path(), kv::Access::read_write);
  database.put(with_face("a", 1));
  EXPECT_TRUE(database.relayout("a", {AccessMode{AccessMode::Kind::by_joint, 0}, {}}));
  const std::optional<motion_db::StoredMotion> stored = database.info("a")->motion;
  EXPECT_FALSE(database.relayout("a", {AccessMode{AccessMode::Kind::by_joint, 0}, {}}));
  EXPECT_EQ(database.info("a")->motion, stored) << "not even a new generation";
  EXPECT_TRUE(database.relayout("a", {AccessMode{AccessMode::Kind::by_frame, 0}, {}}));
  const AccessMode fitted = database.info("a")->motion->mode;
  EXPECT_FALSE(database.relayout("a", {AccessMode{AccessMode::Kind::by_frame, 0}, {}})) << "nor with a default p";
  EXPECT_FALSE(database.relayout("a", {fitted, {}}));
}

TEST_P(RelayoutTest, AnInterruptedOneKeepsTheOldPackets) {
  Database database(path(), kv::Access::read_write);
  database.put(small_recording("a", 1, {"A"}, 4'000));
  const std::optional<motion_db::StoredMotion> stored = database.info("a")->motion;
  const std::uint64_t entries = database.engine().entries;
  struct Stop {};
  EXPECT_THROW(database.relayout("a", {AccessMode{AccessMode::Kind::by_joint_and_frame, 2}, {}},
                                 [](double done) {
                                   if (done > 0.5) throw Stop{};
                                 }),
               Stop);
  EXPECT_EQ(database.info("a")->motion, stored);
  EXPECT_TRUE(same_poses(database.read("a"), small_motion(4'000, 1)));
  EXPECT_EQ(database.engine().entries, entries);
}

TEST_P(RelayoutTest, ADamagedMotionIsNotChanged) {
  Database database(path(), kv::Access::read_write);
  database.put(small_recording("a", 1, {"A"}));
  const std::optional<motion_db::StoredMotion> stored = database.info("a")->motion;
  {
    const auto store = kv::open(path(), kv::Access::read_write);
    Bytes last;
    store->visit([&](ByteSpan key, std::size_t) {
      if (motion_db::kind_of(key) == "packets") last = std::max(last, Bytes(key.begin(), key.end()));
    });
    const auto change = store->write();
    const ByteSpan value = *change->get(last);
    Bytes damaged(value.begin(), value.end());
    damaged[50] ^= std::byte{1};
    change->put(last, damaged);
    change->commit();
  }
  EXPECT_THROW(database.relayout("a", {AccessMode{AccessMode::Kind::full, 0}, {}}), Error);
  EXPECT_EQ(database.info("a")->motion, stored);
  EXPECT_TRUE(same_poses(database.read("a", {0, 200}), small_motion(300, 1).slice({0, 200}))) << "the rest is readable";
}

TEST_P(RelayoutTest, AnUnknownNameOrAMissingMotionChangesNothing) {
  Database database(path(), kv::Access::read_write);
  Recording annotation = small_recording("words", 1, {"A"});
  annotation.motion.reset();
  database.put(annotation);
  EXPECT_FALSE(database.relayout("words", {AccessMode{AccessMode::Kind::full, 0}, {}}));
  EXPECT_THROW(database.relayout("wrods", {AccessMode{AccessMode::Kind::full, 0}, {}}), Error);
}

TEST_P(RelayoutTest, LaterMotionsUseTheModeThatWasSet) {
  Database database(path(), kv::Access::read_write);
  database.set_storage({AccessMode{AccessMode::Kind::by_joint, 0}, {}});
  database.put(small_recording("a", 1, {"A"}));
  EXPECT_EQ(to_string(database.info("a")->motion->mode), "by_joint");
}

TEST_P(RelayoutTest, ACompactMotionIsRoundedOnceAndThenKeptBitForBit) {
  Database database(path(), kv::Access::read_write);
  const Motion captured = with_face("a", 1).motion->motion;
  database.put(with_face("a", 1));
  const std::uint64_t exact = bytes_of_packets(database);
  EXPECT_TRUE(database.relayout("a", {{}, 0.0001f}));
  EXPECT_EQ(database.info("a")->motion->tolerance, 0.0001f);
  EXPECT_EQ(database.info("a")->motion->mode.frames_per_packet, 32u) << "p was given, and stays";
  const Motion rounded = database.read("a");
  EXPECT_FALSE(same_bits(rounded, captured));
  EXPECT_LE(motion_db::largest_distance(rounded, captured), 0.0001);
  EXPECT_EQ(rounded.tracks(), captured.tracks()) << "faces stay as they are";
  EXPECT_LT(bytes_of_packets(database), exact / 2);
  for (const char* mode : kModes) {
    database.relayout("a", {*parse_access_mode(mode), {}});
    EXPECT_TRUE(same_bits(database.read("a"), rounded)) << mode;
    EXPECT_TRUE(same_bits(database.read("a", {31, 222}), rounded.slice({31, 222}))) << mode;
    EXPECT_EQ(database.info("a")->motion->tolerance, 0.0001f);
  }
  EXPECT_FALSE(database.relayout("a", {{}, 0.0001f})) << "it is so already";
  EXPECT_THROW(database.relayout("a", {{}, 0.001f}), Error) << "rounded again, it would be further off than it says";
  EXPECT_THROW(database.relayout("a", {{}, 0.0f}), Error);
  EXPECT_TRUE(same_bits(database.read("a"), rounded));
  EXPECT_THAT(check(database).faults, ElementsAre());
}

TEST_P(RelayoutTest, LaterMotionsAreRoundedWithTheToleranceThatWasSet) {
  Database::create(folder_ / "small", {.engine = GetParam(), .tolerance = 0.0005f});
  Database database(folder_ / "small", kv::Access::read_write);
  database.put(with_face("a", 1));
  const Motion rounded = database.read("a");
  EXPECT_EQ(database.info("a")->motion->tolerance, 0.0005f);
  EXPECT_LE(motion_db::largest_distance(rounded, with_face("a", 1).motion->motion), 0.0005);
  // A motion that was rounded before, as when a face is added to it, is stored unchanged.
  Recording again = with_face("a", 1);
  again.motion = MotionPart{.motion = rounded, .rounded_within = 0.0005f};
  database.put(again);
  EXPECT_TRUE(same_bits(database.read("a"), rounded));
  EXPECT_EQ(database.info("a")->motion->tolerance, 0.0005f);
  for (const float wrong : {-1.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_THROW(database.set_storage({{}, wrong}), Error);
    EXPECT_THROW(Database::create(folder_ / "wrong", {.engine = GetParam(), .tolerance = wrong}), Error);
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "wrong"));
}

TEST_P(RelayoutTest, ConcurrentReadersSeeTheSameMotionAllTheTime) {
  Database database(path(), kv::Access::read_write);
  const Motion motion = small_motion(2'000, 4);
  database.put(small_recording("a", 4, {"A"}, 2'000));
  std::atomic<bool> stop = false;
  std::atomic<int> reads = 0;
  std::vector<std::thread> readers;
  for (int i = 0; i < 2; ++i) {
    readers.emplace_back([&, i] {
      std::int64_t at = 0;
      while (!stop) {
        try {
          at = (at + 377) % 1'900;
          const FrameRange frames{at, at + 100};
          if (i == 0) {
            EXPECT_TRUE(same_poses(database.read("a", frames), motion.slice(frames)));
          } else {
            const Snapshot snapshot = database.snapshot();
            const auto source = snapshot.motion(snapshot.contents().at("a"));
            Motion part;
            part.reset(source->skeleton(), source->rate(), 100);
            source->read(frames, part.poses({0, 100}));
            EXPECT_TRUE(same_poses(part, motion.slice(frames)));
          }
          ++reads;
        } catch (const Error& error) {
          ADD_FAILURE() << error.what();
        }
      }
    });
  }
  int changed = 0;
  for (int i = 0; i < 12 || reads < 40; ++i) {
    changed += database.relayout("a", {*parse_access_mode(kModes[i % std::size(kModes)]), {}}) ? 1 : 0;
    if (i > 2'000) break;
  }
  stop = true;
  for (std::thread& reader : readers) reader.join();
  EXPECT_GE(changed, 10);
  EXPECT_GE(reads, 40);
}

}  // namespace
}  // namespace signweave
