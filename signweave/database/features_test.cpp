// Features of phases: measured when a recording is stored, and again when part of it changes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/database/check.h"
#include "signweave/database/import.h"
#include "signweave/database/test_signing.h"
#include "signweave/query/parse.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {
namespace {

using namespace testing_database;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Scene {
  TestFolder folder;
  Scene() {
    Database::create(folder / "db", {});
    database = std::make_unique<Database>(folder / "db", kv::Access::read_write);
  }
  std::unique_ptr<Database> database;
};

/// Measures the phases again from the stored motion.
RecordingFeatures measured_again(const Database& database, const std::string& name) {
  const RecordingInfo info = *database.info(name);
  const Motion motion = database.read(name);
  const AnnotationDocument document = database.document(name);
  const SegmentChunk segments = segments_of(document, signs_in(document, info.tiers).signs);
  return measure_phases(motion, model_of(motion, info.rig), semantic_db::phase_spans(segments), info.clock);
}

void expect_current(Database& database, const std::string& name) {
  EXPECT_FALSE(database.measure(name)) << "nothing was stored";
  const RecordingFeatures stored = database.features(name);
  const RecordingFeatures again = measured_again(database, name);
  EXPECT_EQ(stored.why_not, again.why_not);
  ASSERT_EQ(stored.phases.size(), again.phases.size());
  for (std::size_t i = 0; i < stored.phases.size(); ++i) {
    EXPECT_TRUE(nearly_same(stored.phases[i], again.phases[i])) << i;
  }
  EXPECT_THAT(check(database).faults, IsEmpty());
}

TEST(Features, AreStoredForEveryPhaseInTheOrderOfItsRows) {
  Scene scene;
  scene.database->put(recording_of("a", 1, {"A", "B"}));
  const RecordingFeatures features = scene.database->features("a");
  EXPECT_EQ(features.why_not, "");
  ASSERT_EQ(features.phases.size(), 6u);
  for (const PhaseFeatures& phase : features.phases) {
    EXPECT_TRUE(phase.known);
    EXPECT_GT(phase.hands[1].peak_speed, 0.1f);
    EXPECT_LT(phase.hands[0].peak_speed, 0.01f);
  }
  const Segments table = scene.database->contents()->segments;
  std::size_t at = 0;
  for (RowId row = 0; row < table.row_count(); ++row) {
    if (table.kind(row) != RowKind::phase) continue;
    const auto ms = static_cast<float>(table.span(row).duration().count());
    EXPECT_NEAR(features.phases[at++].seconds, ms / 1000, 0.011f);
  }
  expect_current(*scene.database, "a");
}

TEST(Features, FollowEveryChange) {
  Scene scene;
  Database& database = *scene.database;
  database.put(recording_of("a", 1, {"A", "B"}));
  const RecordingFeatures first = database.features("a");

  Recording words = recording_of("a", 1, {"A", "B", "C"});
  words.motion.reset();
  database.put(words);
  EXPECT_EQ(database.features("a").phases.size(), 9u);
  expect_current(database, "a");

  Recording motion = recording_of("a", 3, {});
  motion.annotation.reset();
  database.put(motion);
  EXPECT_EQ(database.features("a").phases.size(), 9u);
  EXPECT_GT(database.features("a").phases[1].hands[1].peak_speed, first.phases[1].hands[1].peak_speed);
  expect_current(database, "a");

  Recording clock{.name = "a", .signer = "s", .motion = {}, .annotation = {}};
  clock.clock = {.frame_time = Seconds(0.01), .origin = Seconds(0.35)};
  database.put(clock);
  EXPECT_FALSE(database.features("a").phases[0].known) << "before the first frame";
  expect_current(database, "a");

  Recording rig = clock;
  rig.clock.origin = Seconds(0);
  rig.rig = RigNames{{Part::right_hand, ""}};
  database.put(rig);
  EXPECT_FALSE(database.features("a").phases[1].hands[1].known) << "the mapping file says that there is none";
  expect_current(database, "a");
  EXPECT_EQ(database.info("a")->rig, *rig.rig);

  EXPECT_TRUE(database.relayout("a", {.mode = {}, .tolerance = 0.001f}));
  expect_current(database, "a");

  database.remove("a");
  EXPECT_THAT(database.usage(), testing::Not(testing::Contains(testing::Field(&Usage::kind, "features"))));
}

TEST(Features, AMappingFileThatNamesNoJointChangesNothing) {
  Scene scene;
  scene.database->put(recording_of("a", 1, {"A"}));
  Recording wrong = recording_of("a", 2, {"A"});
  wrong.rig = RigNames{{Part::right_hand, "RightHandd"}};
  EXPECT_THROW(scene.database->put(wrong), Error);
  EXPECT_TRUE(same_poses(scene.database->read("a"), signing(300, 1)));
  expect_current(*scene.database, "a");
}

TEST(Features, AMappingFileMustFitAMotionThatHasNoAnnotationYet) {
  Scene scene;
  Recording motion = recording_of("a", 1, {});
  motion.annotation.reset();
  scene.database->put(motion);
  Recording rig{.name = "a", .signer = "s", .motion = {}, .annotation = {}};
  rig.clock = motion.clock;
  rig.rig = RigNames{{Part::right_hand, "RightHandd"}};
  EXPECT_THROW(scene.database->put(rig), Error);
  EXPECT_TRUE(scene.database->info("a")->rig.empty());
}

TEST(Features, WithoutHandsHaveAReason) {
  Scene scene;
  Recording recording = recording_of("a", 1, {"A"});
  recording.rig = RigNames{{Part::right_hand, ""}, {Part::left_hand, ""}};
  scene.database->put(recording);
  EXPECT_THAT(scene.database->features("a").why_not, AllOf(HasSubstr("left wrist"), HasSubstr("right wrist")));
  expect_current(*scene.database, "a");
}

TEST(Features, OfSignsOutsideTheMotionHaveAReason) {
  Scene scene;
  Recording recording = recording_of("a", 1, {"A"});
  recording.clock.origin = Seconds(60);
  scene.database->put(recording);
  EXPECT_THAT(scene.database->features("a").why_not, HasSubstr("no phase lies within the motion"));
  expect_current(*scene.database, "a");
}

TEST(Features, WithoutShoulderWidthHaveAReason) {
  Scene scene;
  Recording recording = recording_of("a", 1, {"A"});
  recording.rig = RigNames{{Part::left_upper_arm, "LeftShoulder"}, {Part::right_upper_arm, "RightShoulder"}};
  scene.database->put(recording);  // collar bones six centimetres apart
  EXPECT_THAT(scene.database->features("a").why_not, HasSubstr("too near"));
  expect_current(*scene.database, "a");
}

TEST(Features, WithoutABodyHaveAReason) {
  Scene scene;
  scene.database->put(small_recording("a", 1, {"A"}));
  const RecordingFeatures features = scene.database->features("a");
  EXPECT_THAT(features.why_not, HasSubstr("shoulder"));
  ASSERT_EQ(features.phases.size(), 3u);
  EXPECT_FALSE(features.phases[0].known);
  expect_current(*scene.database, "a");
}

TEST(Features, OfOneHalfNameTheMissingOne) {
  Scene scene;
  Recording words = recording_of("words", 1, {"A"});
  words.motion.reset();
  scene.database->put(words);
  EXPECT_EQ(scene.database->features("words").why_not, "annotation without motion");
  EXPECT_EQ(scene.database->features("words").phases.size(), 3u);
  Recording motion = recording_of("motion", 1, {});
  motion.annotation.reset();
  scene.database->put(motion);
  EXPECT_EQ(scene.database->features("motion").why_not, "motion without annotation");
  EXPECT_THAT(check(*scene.database).faults, IsEmpty());
}

/// Writes directly into the store, to simulate damage or an earlier version.
template <typename Change>
void change_behind(const TestFolder& folder, Change change) {
  const std::unique_ptr<kv::KvStore> store = kv::open(folder / "db", kv::Access::read_write);
  const std::unique_ptr<kv::WriteTransaction> transaction = store->write();
  change(*transaction);
  transaction->commit();
}

TEST(Features, CheckMeasuresASampleAgain) {
  Scene scene;
  scene.database->put(recording_of("a", 1, {"A"}));
  const std::uint64_t document = scene.database->info("a")->document;
  RecordingFeatures wrong = scene.database->features("a");
  scene.database.reset();
  wrong.phases[1].hands[1].end.position.y() += 0.1f;
  change_behind(scene.folder, [&](kv::WriteTransaction& to) { semantic_db::put_features(to, document, wrong); });
  const Database database(scene.folder / "db", kv::Access::read_only);
  EXPECT_THAT(check(database).faults, ElementsAre(HasSubstr("a: the stored features are not those of its motion (the "
                                                            "phase from 100 to 300 ms)")));
}

TEST(Features, OfAnEarlierVersionAreMeasuredWhenReadAndStoredOnRequest) {
  Scene scene;
  scene.database->put(recording_of("a", 1, {"A"}));
  EXPECT_FALSE(scene.database->measure("a"));
  const std::uint64_t document = scene.database->info("a")->document;
  scene.database.reset();
  change_behind(scene.folder, [&](kv::WriteTransaction& to) {
    ByteWriter key;
    key.number('F');
    key.number(document);
    to.erase(key.bytes());
  });
  {
    Database database(scene.folder / "db", kv::Access::read_write);
    EXPECT_EQ(database.features("a").phases.size(), 3u);
    EXPECT_TRUE(database.features("a").phases[0].known);
    EXPECT_TRUE(database.measure("a"));
    expect_current(database, "a");
  }
}

TEST(Features, DamagedOnesAreReportedAndMeasuredAgain) {
  Scene scene;
  scene.database->put(recording_of("a", 1, {"A"}));
  const std::uint64_t document = scene.database->info("a")->document;
  scene.database.reset();
  change_behind(scene.folder, [&](kv::WriteTransaction& to) {
    ByteWriter key;
    key.number('F');
    key.number(document);
    const ByteSpan record = *to.get(key.bytes());
    Bytes damaged(record.begin(), record.end());
    damaged[20] ^= std::byte{1};
    to.put(key.bytes(), damaged);
  });
  Database database(scene.folder / "db", kv::Access::read_write);
  EXPECT_THAT(check(database).faults, ElementsAre(HasSubstr("a: features")));
  EXPECT_THROW(database.features("a"), Error);
  EXPECT_TRUE(database.measure("a"));
  expect_current(database, "a");
}

TEST(Features, ASearchStoppedWhileItMeasuresLeavesNoPartialResult) {
  Scene scene;
  for (int i = 0; i < 3; ++i) {
    scene.database->put(recording_of(std::string(1, static_cast<char>('a' + i)), 1 + i, {"A", "B", "C"}));
  }
  for (const char* text : {"phase = stroke & speed(right_hand) > 0.1 m/s", "speed(right_elbow) >= 0 m/s",
                           "like(\"b\"@100..300)", "like(\"b\"@100..300, right_elbow, right_hand)"}) {
    SCOPED_TRACE(text);
    const PhaseQuery query = parse(text);
    const std::vector<Segment> expected = scene.database->find(query);
    ASSERT_THAT(expected, testing::SizeIs(testing::Ge(3u)));
    int stopped = 0;
    int answered = 0;
    for (int i = 0; i < 200 && answered < 3; ++i) {
      const Database database(scene.folder / "db", kv::Access::read_only);  // with an empty cache
      database.contents();
      const auto time = std::chrono::microseconds(10 << i / 8);
      try {
        database.find(query, {.limit = {}, .deadline = std::chrono::steady_clock::now() + time});
        ++answered;
      } catch (const Error& error) {
        ASSERT_EQ(error.code(), ErrorCode::cancelled);
        ++stopped;
      }
      const std::vector<Segment> found = database.find(query);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_EQ(found[k].row, expected[k].row);
        EXPECT_EQ(found[k].distance, expected[k].distance);
      }
    }
    EXPECT_GT(stopped, 0);
    EXPECT_EQ(answered, 3);
  }
}

}  // namespace
}  // namespace signweave
