#include "signweave/database/import_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "signweave/database/import.h"
#include "signweave/database/test_import.h"

namespace signweave {
namespace {

using namespace testing_database;
using testing::HasSubstr;

class ImportPlanTest : public ImportTest {
 protected:
  Database open() const { return Database(folder_ / "db", kv::Access::read_write); }
  ImportJob job(std::size_t index = 0) const { return pair_files({files()}).jobs.at(index); }
  /// Plans with a database opened read-only.
  ImportPlan plan(const ImportOptions& options = {}) const {
    return plan_import(Database(folder_ / "db", kv::Access::read_only), job(), options);
  }
  std::string error_of_plan(const ImportOptions& options = {}) const {
    try {
      plan(options);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
  /// Returns the code of the error that applying a plan throws.
  std::optional<ErrorCode> refusal(const ImportPlan& planned, const Database::Progress& progress = {}) {
    Database database = open();
    return refusal(database, planned, progress);
  }
  static std::optional<ErrorCode> refusal(Database& database, const ImportPlan& planned,
                                          const Database::Progress& progress = {}) {
    try {
      apply(database, planned, progress);
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("has changed since its import was planned"));
      return error.code();
    }
    return std::nullopt;
  }
};

TEST_F(ImportPlanTest, APlanGivesTheChangeOfEachPart) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"});
  const ImportPlan first = plan();
  EXPECT_EQ(first.outcome, ImportOutcome::added);
  EXPECT_EQ(first.changes.motion, PartChange::added);
  EXPECT_EQ(first.changes.annotation, PartChange::added);
  EXPECT_EQ(first.changes.face, PartChange::none);
  EXPECT_EQ(first.changes.clock, PartChange::added);
  EXPECT_EQ(first.frames, 200);
  EXPECT_EQ(first.signs, 1u);
  import_all();
  const ImportPlan again = plan();
  EXPECT_EQ(again.outcome, ImportOutcome::unchanged);
  EXPECT_EQ(again.changes.motion, PartChange::kept);
  EXPECT_EQ(again.changes.annotation, PartChange::kept);

  write_annotation("a.eaf", {"B"});
  write_text("a.face.csv", face_text("0.5"));
  const ImportPlan second = plan({.offset = Seconds(0.5)});
  EXPECT_EQ(second.outcome, ImportOutcome::face_added);
  EXPECT_EQ(second.changes.motion, PartChange::kept);
  EXPECT_EQ(second.changes.face, PartChange::added);
  EXPECT_EQ(second.changes.annotation, PartChange::replaced);
  EXPECT_EQ(second.changes.clock, PartChange::replaced);
  EXPECT_EQ(second.changes.signer, PartChange::none);
  EXPECT_EQ(import_all({.offset = Seconds(0.5)}), std::vector{ImportOutcome::face_added});

  std::filesystem::remove(files() / "a.face.csv");
  const ImportPlan third = plan({.replace_motion = true});
  EXPECT_EQ(third.outcome, ImportOutcome::motion_replaced);
  EXPECT_EQ(third.changes.motion, PartChange::replaced);
  EXPECT_EQ(third.changes.face, PartChange::removed);
  EXPECT_EQ(third.changes.clock, PartChange::kept);
}

TEST_F(ImportPlanTest, PlanningChangesNothing) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"});
  import_all();
  write_annotation("a.eaf", {"B"});
  EXPECT_EQ(plan().outcome, ImportOutcome::annotation_replaced);
  EXPECT_EQ(plan().outcome, ImportOutcome::annotation_replaced);
  Database database = open();
  const ImportReport report = apply(database, plan_import(database, job(), {}));
  EXPECT_EQ(report.outcome, ImportOutcome::annotation_replaced);
  EXPECT_EQ(report.signs, 1u);
  EXPECT_EQ(plan_import(database, job(), {}).outcome, ImportOutcome::unchanged);
}

TEST_F(ImportPlanTest, PlanningThrowsTheRefusals) {
  write_motion("a.bvh", 1);
  EXPECT_THAT(error_of_plan({.offset = Seconds(1e300)}), HasSubstr("offset_ms"));
  EXPECT_THAT(error_of_plan({.rig = RigNames{{Part::head, "Hed"}}}), HasSubstr("a: its mapping file: "));
  ImportOptions fitting;
  fitting.rig = RigNames{{Part::head, "Hand"}};
  import_all(fitting);
  EXPECT_THAT(error_of_plan({.rig = RigNames{{Part::head, "Hed"}}}), HasSubstr("a: its mapping file: "));
  write_motion("a.bvh", 2);
  EXPECT_THAT(error_of_plan(), HasSubstr("is not the motion that recording 'a' was imported from"));
  Motion other(std::make_shared<const Skeleton>(
                   std::vector<Joint>{{"Hips", kNoJoint, {0, 1, 0}, true}, {"Paw", 0, {0.5f, 0, 0}, false}},
                   std::vector<Tip>{{1, {0.1f, 0, 0}}}),
               {100, 1}, 10);
  bvh::write(files() / "a.bvh", other, bvh::default_layout(other.skeleton()));
  EXPECT_THAT(error_of_plan({.replace_motion = true}), HasSubstr("a: the mapping file of an earlier import says "));
}

TEST_F(ImportPlanTest, APlanOfAnOlderStateIsRefused) {
  write_motion("a.bvh", 1);
  write_annotation("a.eaf", {"A"});
  const ImportPlan adds = plan();
  import_all();
  EXPECT_EQ(refusal(adds), ErrorCode::conflict) << "the recording has been added";
  const ImportPlan nothing = plan();
  const ImportPlan moves = plan({.offset = Seconds(0.5)});
  write_annotation("a.eaf", {"B"});
  const ImportPlan replaces = plan();
  write_annotation("a.eaf", {"C"});
  import_all();
  for (const ImportPlan* old : {&nothing, &moves, &replaces}) EXPECT_EQ(refusal(*old), ErrorCode::conflict);
  EXPECT_EQ(open().document("a").tiers, small_document({"C"}).tiers) << "what the other import stored stays";
  const ImportPlan current = plan({.offset = Seconds(0.5)});
  EXPECT_EQ(refusal(current), std::nullopt);
  open().remove("a");
  EXPECT_EQ(refusal(moves), ErrorCode::conflict) << "the recording is gone";
}

TEST_F(ImportPlanTest, AnEntryUnderAShorterNameIsPartOfTheKnownState) {
  write_motion("x/a.bvh", 1);
  write_motion("y/a.bvh", 2);
  const ImportPlan planned = plan();
  EXPECT_EQ(planned.recording.name, "x/a");
  Database database = open();
  database.put(small_recording("b", 3, {"B"}));
  database.put(small_recording("a", 3, {"A"}));
  EXPECT_EQ(refusal(database, planned), ErrorCode::conflict);
  database.remove("a");
  EXPECT_EQ(refusal(database, planned), std::nullopt) << "the entry of another recording is not";
}

TEST_F(ImportPlanTest, AChangeWhileThePlanIsAppliedIsNoticed) {
  write_motion("a.bvh", 1);
  const ImportPlan planned = plan();
  Database database = open();
  database.set_storage({.mode = {}, .tolerance = 0.001f});  // rounding reports progress before the motion is written
  bool changed = false;
  const auto change = [&](double) {
    if (!std::exchange(changed, true)) database.put(small_recording("a", 3, {"A"}));
  };
  EXPECT_EQ(refusal(database, planned, change), ErrorCode::conflict);
  ASSERT_TRUE(changed);
  EXPECT_EQ(database.document("a").tiers, small_document({"A"}).tiers);
  database.remove("a");
  const std::vector<Usage> left = database.usage();
  EXPECT_EQ(std::ranges::count(left, "packets", &Usage::kind), 0) << "the motion of the refused plan is gone";
}

}  // namespace
}  // namespace signweave
