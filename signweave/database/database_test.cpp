#include "signweave/database/database.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <thread>

#include "signweave/database/check.h"
#include "signweave/database/test_recording.h"
#include "signweave/formats/eaf/eaf.h"
#include "signweave/query/parse.h"

namespace signweave {
namespace {

using namespace testing_database;
using testing::ElementsAre;
using testing::HasSubstr;

template <typename Action>
std::string fault_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no fault";
}

std::vector<std::string> names_in(const Database& database) {
  std::vector<std::string> names;
  const std::shared_ptr<const Contents> contents = database.contents();
  for (const RecordingInfo& info : contents->recordings) names.push_back(info.name);
  return names;
}

/// The tests below run for each engine and access mode.
class DatabaseInMode : public testing::TestWithParam<std::tuple<std::string, const char*>> {
 protected:
  DatabaseInMode() {
    const auto& [engine, mode] = GetParam();
    Database::create(folder_ / "db", {.engine = engine, .access_mode = *parse_access_mode(mode)});
  }
  std::filesystem::path path() const { return folder_ / "db"; }
  TestFolder folder_;
};

TEST_P(DatabaseInMode, AStoredMotionReadsBackBitForBit) {
  const Recording recording = small_recording("meteo", 3, {"MATIN", "NUAGES"});
  {
    Database database(path(), kv::Access::read_write);
    database.put(recording);
  }
  const Database database(path(), kv::Access::read_only);
  EXPECT_TRUE(same_poses(database.read("meteo"), recording.motion->motion));
  EXPECT_TRUE(same_poses(database.read("meteo", {20, 97}), recording.motion->motion.slice({20, 97})));
  EXPECT_EQ(database.info("meteo")->signer, "s3");
  EXPECT_EQ(database.document("meteo").tiers, recording.annotation->document.tiers);
  EXPECT_TRUE(check(database).faults.empty());
}

TEST_P(DatabaseInMode, AnAnswerReadsItsFrames) {
  Database database(path(), kv::Access::read_write);
  const Recording recording = small_recording("meteo", 3, {"MATIN", "NUAGES"});
  database.put(recording);
  const std::vector<Segment> strokes = database.find(parse("gloss = \"NUAGES\" & phase = stroke"));
  ASSERT_EQ(strokes.size(), 1u);
  EXPECT_EQ(strokes[0].span, (TimeSpan{500ms, 700ms}));
  EXPECT_TRUE(same_poses(database.read(strokes[0]), recording.motion->motion.slice({50, 70})));
}

TEST_P(DatabaseInMode, APartialReadTouchesOnlyThePacketsItNeeds) {
  Database database(path(), kv::Access::read_write);
  database.put(small_recording("meteo", 3, {"MATIN"}, 300));
  const AccessMode mode = database.info("meteo")->motion->mode;
  motion_db::ReadCost all_joints;
  database.read("meteo", {100, 110}, {}, &all_joints);
  motion_db::ReadCost one_joint;
  database.read("meteo", {100, 110}, {1}, &one_joint);
  const bool by_frame = mode.kind == AccessMode::Kind::by_frame || mode.kind == AccessMode::Kind::by_joint_and_frame;
  const bool by_joint = mode.kind == AccessMode::Kind::by_joint || mode.kind == AccessMode::Kind::by_joint_and_frame;
  const std::uint64_t packets_in_time = by_frame ? 109 / mode.frames_per_packet - 100 / mode.frames_per_packet + 1 : 1;
  EXPECT_EQ(all_joints.packets, packets_in_time * (by_joint ? 2 : 1));
  EXPECT_EQ(one_joint.packets, packets_in_time);
}

INSTANTIATE_TEST_SUITE_P(EveryMode, DatabaseInMode,
                         testing::Combine(testing::ValuesIn(kv::engines()),
                                          testing::Values("full", "by_frame:64", "by_frame", "by_joint",
                                                          "by_joint_and_frame:16")),
                         [](const auto& tested) {
                           std::string name = std::get<0>(tested.param) + "_" + std::get<1>(tested.param);
                           std::replace(name.begin(), name.end(), ':', '_');
                           return name;
                         });

/// The tests below run for each engine.
class DatabaseTest : public testing::TestWithParam<std::string> {
 protected:
  DatabaseTest() {
    Database::create(folder_ / "db", {.engine = GetParam(), .access_mode = *parse_access_mode("by_frame:32")});
  }
  std::filesystem::path path() const { return folder_ / "db"; }
  TestFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Engines, DatabaseTest, testing::ValuesIn(kv::engines()),
                         [](const auto& row) { return row.param; });

TEST_P(DatabaseTest, IsCreatedOnlyInAnEmptyFolder) {
  EXPECT_THROW(Database::create(path(), {}), Error);
  EXPECT_THAT(fault_of([&] { Database(folder_ / "none", kv::Access::read_only); }), HasSubstr("none"));
  EXPECT_THAT(fault_of([&] { Database::create(folder_ / "x", {.engine = "oracle"}); }), HasSubstr("oracle"));
}

TEST_P(DatabaseTest, RecordingsAreListedByName) {
  Database database(path(), kv::Access::read_write);
  for (const char* name : {"villes", "meteo", "à propos"}) database.put(small_recording(name, 1, {"A"}));
  EXPECT_THAT(names_in(database), ElementsAre("meteo", "villes", "à propos"));
  database.remove("meteo");
  EXPECT_THAT(names_in(database), ElementsAre("villes", "à propos"));
  EXPECT_TRUE(same_poses(database.read("villes"), small_motion(300, 1)));
}

TEST_P(DatabaseTest, RemovingLeavesNothingBehind) {
  Database database(path(), kv::Access::read_write);
  database.put(small_recording("a", 1, {"A"}));
  database.put(small_recording("b", 2, {"B"}));
  const std::uint64_t before = database.engine().entries;
  database.put(small_recording("c", 3, {"C"}));
  EXPECT_GT(database.engine().entries, before);
  database.remove("c");
  EXPECT_EQ(database.engine().entries, before);
}

TEST_P(DatabaseTest, ReplacingOneHalfKeepsTheOther) {
  Database database(path(), kv::Access::read_write);
  database.put(small_recording("a", 1, {"A"}));
  const std::uint64_t entries = database.engine().entries;
  Recording annotation = small_recording("a", 9, {"B", "C"});
  annotation.motion.reset();
  database.put(annotation);
  EXPECT_TRUE(same_poses(database.read("a"), small_motion(300, 1)));
  EXPECT_EQ(database.find(parse("gloss = \"C\"")).size(), 1u);
  EXPECT_TRUE(database.find(parse("gloss = \"A\"")).empty());

  Recording motion = small_recording("a", 5, {});
  motion.annotation.reset();
  database.put(motion);
  EXPECT_TRUE(same_poses(database.read("a"), small_motion(300, 5)));
  EXPECT_EQ(database.find(parse("gloss = \"C\"")).size(), 1u);
  EXPECT_EQ(database.engine().entries, entries);  // the replaced records are erased
}

TEST_P(DatabaseTest, AReaderSeesChangesAfterTheyAreMade) {
  Database writer(path(), kv::Access::read_write);
  const Database reader(path(), kv::Access::read_only);
  EXPECT_TRUE(names_in(reader).empty());
  writer.put(small_recording("a", 1, {"A"}));
  EXPECT_THAT(names_in(reader), ElementsAre("a"));
  const std::shared_ptr<const Contents> before = reader.contents();
  EXPECT_EQ(reader.contents(), before);  // read again only after a change
  writer.remove("a");
  EXPECT_TRUE(names_in(reader).empty());
  EXPECT_EQ(before->recordings.size(), 1u);  // contents already returned do not change
}

TEST_P(DatabaseTest, OnlyOneMayWrite) {
  const Database first(path(), kv::Access::read_write);
  EXPECT_THAT(fault_of([&] { Database(path(), kv::Access::read_write); }), HasSubstr("is being changed by process "));
}

TEST_P(DatabaseTest, OpenedForReadingItRefusesToWrite) {
  Database database(path(), kv::Access::read_only);
  EXPECT_THAT(fault_of([&] { database.put(small_recording("a", 1, {"A"})); }), HasSubstr("for reading only"));
}

TEST_P(DatabaseTest, FaultsNameTheRecordingAndNearOnes) {
  Database database(path(), kv::Access::read_write);
  database.put(small_recording("meteo", 1, {"A"}));
  EXPECT_THAT(fault_of([&] { database.read("metoe"); }),
              HasSubstr("no recording 'metoe' in this database; did you mean meteo?"));
  EXPECT_THAT(fault_of([&] { database.put(Recording{.name = "x"}); }), HasSubstr("neither motion nor annotation"));
  EXPECT_THAT(fault_of([&] { database.put(small_recording("  ", 1, {"A"})); }), HasSubstr("needs a name"));
}

TEST_P(DatabaseTest, HalvesMayBeMissing) {
  Database database(path(), kv::Access::read_write);
  Recording motion = small_recording("motion", 1, {"A"});
  motion.annotation.reset();
  database.put(motion);
  Recording annotation = small_recording("annotation", 1, {"A"});
  annotation.motion.reset();
  database.put(annotation);
  EXPECT_THAT(fault_of([&] { database.document("motion"); }), HasSubstr("has no annotation"));
  EXPECT_THAT(fault_of([&] { database.read("annotation"); }), HasSubstr("has no motion"));
  EXPECT_TRUE(check(database).faults.empty());
}

TEST_P(DatabaseTest, AnInterruptedPutLeavesTheRecordingAsItWas) {
  Database database(path(), kv::Access::read_write);
  database.put(small_recording("a", 1, {"A"}));
  const std::uint64_t entries = database.engine().entries;
  struct Stop {};
  int calls = 0;
  EXPECT_THROW(database.put(small_recording("a", 2, {"B"}, 300'000),
                            [&](double) {
                              if (++calls > 1) throw Stop{};
                            }),
               Stop);
  EXPECT_TRUE(same_poses(database.read("a"), small_motion(300, 1)));
  EXPECT_EQ(database.engine().entries, entries);
  EXPECT_TRUE(check(database).faults.empty());
}

TEST_P(DatabaseTest, ChecksumsFindADamagedRecordingAndTheOthersStayReadable) {
  {
    Database database(path(), kv::Access::read_write);
    database.put(small_recording("good", 1, {"A"}));
    database.put(small_recording("bad", 2, {"B"}));
  }
  {  // flip one bit in the document of "bad"
    const auto store = kv::open(path(), kv::Access::read_write);
    const auto transaction = store->write();
    ByteWriter key;
    key.number('D');
    key.number(Database(path(), kv::Access::read_only).info("bad")->document);
    const ByteSpan value = *transaction->get(key.bytes());
    Bytes damaged(value.begin(), value.end());
    damaged[100] ^= std::byte{1};
    transaction->put(key.bytes(), damaged);
    transaction->commit();
  }
  const Database database(path(), kv::Access::read_only);
  EXPECT_THAT(check(database).faults, ElementsAre(HasSubstr("bad: annotation document")));
  EXPECT_TRUE(same_poses(database.read("good"), small_motion(300, 1)));
  EXPECT_EQ(database.document("good").tiers.size(), 2u);
}

/// Puts recordings r0 to r4 in turn until killed; writes the number of each to the pipe after it is stored.
[[noreturn]] void put_until_killed(const std::filesystem::path& path, int pipe) {
  Database database(path, kv::Access::read_write);
  for (int i = 0;; ++i) {
    database.put(small_recording("r" + std::to_string(i % 5), i, {"A"}, 20'000));
    if (::write(pipe, &i, sizeof i) != sizeof i) ::_exit(1);
  }
}

TEST_P(DatabaseTest, AfterAKillAtAnyMomentEachRecordingIsTheOldOrTheNew) {
  for (int round = 0; round < 8; ++round) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) put_until_killed(path(), ends[1]);
    ::close(ends[1]);
    int last = -1;
    for (int count = 0; count < 2 + round; ++count)
      ASSERT_EQ(::read(ends[0], &last, sizeof last), static_cast<ssize_t>(sizeof last));
    ::usleep(static_cast<unsigned>(1'700 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    int sent = 0;
    while (::read(ends[0], &sent, sizeof sent) == sizeof sent) last = sent;
    ::close(ends[0]);

    Database database(path(), kv::Access::read_write);
    EXPECT_THAT(check(database).faults, ElementsAre());
    for (int i = std::max(0, last - 4); i <= last;
         ++i) {  // acknowledged: it or the one that was replacing it is stored
      const Motion motion = database.read("r" + std::to_string(i % 5));
      EXPECT_TRUE(same_poses(motion, small_motion(20'000, i)) || same_poses(motion, small_motion(20'000, i + 5))) << i;
    }
    // Nothing is left of the interrupted put.
    std::uint64_t expected =
        3 + database.segments()->members().size();  // head, sweep list, segment tables and their list
    const std::shared_ptr<const Contents> contents = database.contents();
    for (const RecordingInfo& info : contents->recordings) {
      expected += 1 + 4 + motion_db::packet_count(*info.motion) + 1;  // entry; 4 of the document; packets; skeleton
    }
    EXPECT_EQ(database.engine().entries, expected);
  }
}

Motion whole(const MotionSource& source) {
  Motion motion;
  motion.reset(source.skeleton(), source.rate(), source.frame_count());
  source.read({0, source.frame_count()}, motion.poses({0, source.frame_count()}));
  return motion;
}

TEST_P(DatabaseTest, ASnapshotDoesNotSeeLaterChanges) {
  Database database(path(), kv::Access::read_write);
  database.put(small_recording("a", 1, {"A"}));
  const Snapshot before = database.snapshot();
  database.put(small_recording("a", 2, {"B"}, 50));
  database.put(small_recording("b", 3, {"C"}));
  ASSERT_EQ(before.contents().recordings.size(), 1u);
  EXPECT_TRUE(same_poses(whole(*before.motion(before.contents().recordings[0])), small_motion(300, 1)));
  const Snapshot after = database.snapshot();
  EXPECT_TRUE(same_poses(whole(*after.motion(after.contents().at("a"))), small_motion(50, 2)));
  // The database itself shows the current state, although an older snapshot exists.
  EXPECT_EQ(database.contents()->recordings.size(), 2u);
}

TEST_P(DatabaseTest, QuaternionsAreStoredInOneHemisphere) {
  Database database(path(), kv::Access::read_write);
  Recording recording = small_recording("a", 1, {"A"});
  Motion& motion = recording.motion->motion;
  for (Eigen::Quaternionf& q : motion.pose(7).rotations) q.coeffs() *= -1.0f;
  ASSERT_FALSE(keeps_hemisphere(motion));
  database.put(recording);
  EXPECT_TRUE(same_poses(database.read("a"), small_motion(300, 1)));
}

TEST_P(DatabaseTest, AnUnreadableEntryIsReportedUntilItIsRemoved) {
  {
    Database database(path(), kv::Access::read_write);
    for (const char* name : {"a", "b", "c"}) database.put(small_recording(name, 1, {"A"}));
  }
  {  // flip one bit in the second entry
    const auto store = kv::open(path(), kv::Access::read_write);
    const auto transaction = store->write();
    ByteWriter key;
    key.number('R');
    key.number(std::uint32_t{1});
    const ByteSpan value = *transaction->get(key.bytes());
    Bytes damaged(value.begin(), value.end());
    damaged[20] ^= std::byte{1};
    transaction->put(key.bytes(), damaged);
    transaction->commit();
  }
  Database database(path(), kv::Access::read_write);
  const auto entries_of_recordings = [&] {  // without head, sweep list, segment tables and their list
    return database.engine().entries - 3 - database.segments()->members().size();
  };
  const std::uint64_t entries = entries_of_recordings();
  EXPECT_THAT(names_in(database), ElementsAre("a", "c"));
  EXPECT_EQ(database.contents()->faults.size(), 1u);
  database.put(small_recording("d", 2, {"B"}));
  database.remove("d");
  database.remove("c");  // the damaged one is moved as it is
  EXPECT_THAT(names_in(database), ElementsAre("a"));
  ASSERT_THAT(check(database).faults, ElementsAre(HasSubstr("catalogue entry 1: ")));
  EXPECT_THROW(database.remove("catalogue entry 0"), Error);
  database.remove("catalogue entry 1");
  EXPECT_THAT(names_in(database), ElementsAre("a"));
  EXPECT_EQ(entries_of_recordings(), entries / 3) << "only the records of a are left";
  EXPECT_TRUE(check(database).faults.empty());
}

TEST_P(DatabaseTest, ADamagedSweepListCostsNothing) {
  {
    Database database(path(), kv::Access::read_write);
    database.put(small_recording("a", 1, {"A"}));
  }
  std::uint64_t entries = 0;
  {  // a motion that no entry names, as a crash leaves it, and a list that does not contain it
    const auto store = kv::open(path(), kv::Access::read_write);
    entries = store->info().entries;
    motion_db::put(*store, motion_db::describe(small_motion(2'000, 2), {}, 77), small_motion(2'000, 2));
    const auto transaction = store->write();
    ByteWriter key;
    key.number('P');
    transaction->put(key.bytes(), bytes_of("damaged"));
    transaction->commit();
    ASSERT_GT(store->info().entries, entries);
  }
  EXPECT_THAT(check(Database(path(), kv::Access::read_only)).faults,
              ElementsAre(HasSubstr("sweep list: it is damaged; no recording needs it")));
  const Database database(path(), kv::Access::read_write);
  EXPECT_THAT(check(database).faults, ElementsAre());
  EXPECT_EQ(database.engine().entries, entries);
  EXPECT_TRUE(same_poses(database.read("a"), small_motion(300, 1)));
}

TEST_P(DatabaseTest, ConcurrentReadersSeeWholeRecordingsWhileOneIsReplaced) {
  Database database(path(), kv::Access::read_write);
  database.put(small_recording("a", 0, {"A"}));
  std::atomic<bool> stop = false;
  std::atomic<int> reads = 0;
  std::vector<std::thread> readers;
  for (int i = 0; i < 2; ++i) {
    readers.emplace_back([&] {
      while (!stop) {
        try {
          const Motion motion = database.read("a");
          const int seed = static_cast<int>(std::lround(motion.pose(0).translations[0].x()));
          EXPECT_TRUE(same_poses(motion, small_motion(300, seed)));
          EXPECT_EQ(database.find(parse("phase = stroke")).size(), 1u);
          EXPECT_EQ(database.info("a")->motion->frames, 300);
          EXPECT_EQ(database.document("a").tiers.size(), 2u);
          ++reads;
        } catch (const Error& error) {
          ADD_FAILURE() << error.what();
        }
      }
    });
  }
  for (int i = 1; i <= 30; ++i) database.put(small_recording("a", i, {"A"}));
  while (reads < 20) std::this_thread::yield();
  stop = true;
  for (std::thread& reader : readers) reader.join();
}

}  // namespace
}  // namespace signweave
